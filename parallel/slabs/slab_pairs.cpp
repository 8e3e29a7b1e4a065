#include "parallel/slabs/slab_pairs.hpp"

#include <cstdint>

#include "parallel/slabs/border_disks.hpp"

namespace carom {

namespace {

// Adds the numbers of some counts, one after the other, so many times.
void add_numbers(std::vector<std::int64_t>& sum, const std::vector<PairCounts>& counts, std::int64_t times) {
  std::size_t next = 0;
  const auto add = [&](Count number) {
    if (next == sum.size()) sum.push_back(0);
    sum[next++] += times * static_cast<std::int64_t>(number);
  };
  for (const PairCounts& c : counts) {
    add(c.centres);
    for (const Count number : c.counts) add(number);
  }
}

}  // namespace

// A pair of two ranks is one of the disks at their border, and is found on both: so all that lies within a slab counts
// twice as well, and half of the sum is what there is. Its disks are centres twice, too.
std::optional<std::vector<PairCounts>> pairs_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box,
                                                        const Disks& own, const SlabCut& cut,
                                                        const PairCounter& count) {
  if (!plan.wants(Quantity::pair_correlation) || box.shear.acts()) return std::nullopt;
  const auto pairs_of = [&](const Disks& disks) { return pairs_of_plan(plan, disks, box, count); };
  std::vector<PairCounts> pairs = pairs_of(own);
  std::vector<std::int64_t> numbers;
  add_numbers(numbers, pairs, 2);
  if (ranks.count() > 1) {
    const Slab slab = slab_of(cut, box, ranks.rank());
    const double excursion = excursion_over_ranks(ranks, slab, box, own);
    const double reach = plan.pairs.r_max;
    if (ranks.count() > 2 && !is_within_neighbours(cut, box, reach, excursion)) return std::nullopt;
    const BorderDisks border = disks_at_borders(ranks, slab, box, own, reach, excursion);
    add_numbers(numbers, pairs_of(border.own), -1);
    add_numbers(numbers, pairs_of(border.others), -1);
    add_numbers(numbers, pairs_of(joined(border.own, border.others)), 1);
  }
  ranks.sum(numbers);
  auto next = numbers.begin();
  for (PairCounts& c : pairs) {
    c.centres = static_cast<Count>(*next++) / 2;
    for (Count& number : c.counts) number = static_cast<Count>(*next++) / 2;
  }
  return pairs;
}

}  // namespace carom
