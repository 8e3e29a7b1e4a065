#include "parallel/slabs/slab_pairs.hpp"

#include <cstdint>
#include <functional>

#include "core/measure/bond_correlation.hpp"
#include "core/measure/bond_order.hpp"
#include "core/measure/pair_records.hpp"
#include "parallel/slabs/border_disks.hpp"

namespace carom {

namespace {

// Sums over pairs of some disks and over these disks.
using PairNumbers = std::vector<std::int64_t>;

void add_times(PairNumbers& sum, const PairNumbers& numbers, std::int64_t times) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += times * numbers[k];
}

// The sums for the disks of all ranks, over pairs that are no further apart than reach (length). A pair of two ranks
// consists of disks at their border, and is found on both of them: so everything within a slab is also counted twice,
// and the result is half of the sum. The disks themselves are counted twice, too.
std::optional<PairNumbers> numbers_over_ranks(Ranks& ranks, const Domain& box, const Disks& own, const SlabCut& cut,
                                              double reach,
                                              const std::function<PairNumbers(const Disks&)>& numbers_of) {
  if (ranks.count() == 1) return numbers_of(own);
  const Slab slab = slab_of(cut, box, ranks.rank());
  const double excursion = excursion_over_ranks(ranks, slab, box, own);
  if (ranks.count() > 2 && !is_within_neighbours(cut, box, reach, excursion)) return std::nullopt;
  const BorderDisks border = disks_at_borders(ranks, slab, box, own, reach, excursion);
  PairNumbers numbers = numbers_of(own);
  for (std::int64_t& number : numbers) number *= 2;
  add_times(numbers, numbers_of(border.own), -1);
  add_times(numbers, numbers_of(border.others), -1);
  add_times(numbers, numbers_of(joined(border.own, border.others)), 1);
  ranks.sum(numbers);
  for (std::int64_t& number : numbers) number /= 2;
  return numbers;
}

PairNumbers numbers_in(const std::vector<PairCounts>& pairs) {
  PairNumbers numbers;
  for (const PairCounts& p : pairs) {
    numbers.push_back(static_cast<std::int64_t>(p.centres));
    for (const Count count : p.counts) numbers.push_back(static_cast<std::int64_t>(count));
  }
  return numbers;
}

PairNumbers numbers_in(const BondPairs& pairs) {
  PairNumbers numbers;
  for (const Count count : pairs.counts) numbers.push_back(static_cast<std::int64_t>(count));
  for (const FixedPointSum& product : pairs.product) {
    numbers.push_back(product.high);
    numbers.push_back(product.low);
  }
  return numbers;
}

}  // namespace

std::optional<std::vector<PairCounts>> pairs_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box,
                                                        const Disks& own, const SlabCut& cut, const BlockRunner& run) {
  if (!plan.wants(Quantity::pair_correlation)) return std::nullopt;
  std::vector<PairCounts> pairs;
  const auto numbers = numbers_over_ranks(ranks, box, own, cut, plan.pairs.r_max, [&](const Disks& disks) {
    pairs = pairs_of_plan(plan, disks, box, run);
    return numbers_in(pairs);
  });
  if (!numbers) return std::nullopt;
  auto next = numbers->begin();
  for (PairCounts& p : pairs) {
    p.centres = static_cast<Count>(*next++);
    for (Count& number : p.counts) number = static_cast<Count>(*next++);
  }
  return pairs;
}

std::optional<BondPairs> bond_pairs_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box,
                                               const Disks& orders, const SlabCut& cut, const BlockRunner& run) {
  if (!plan.wants(Quantity::bond_correlation)) return std::nullopt;
  auto disks = static_cast<std::int64_t>(orders.size());
  ranks.sum({&disks, 1});
  if (static_cast<Count>(disks) < least_of_bonds) return std::nullopt;
  BondPairs pairs;
  const auto numbers = numbers_over_ranks(ranks, box, orders, cut, plan.bonds.r_max, [&](const Disks& some) {
    pairs = bond_pairs(some, box, distance_bins(plan.bonds), run);
    return numbers_in(pairs);
  });
  if (!numbers) return std::nullopt;
  auto next = numbers->begin();
  for (Count& number : pairs.counts) number = static_cast<Count>(*next++);
  for (FixedPointSum& product : pairs.product) {
    product.high = *next++;
    product.low = *next++;
  }
  return pairs;
}

}  // namespace carom
