#include "parallel/slabs/rank_sums.hpp"

#include "core/step/step_start.hpp"
#include "parallel/ranks/message.hpp"

namespace carom {

namespace {

// Calls visit(number) for all whole numbers of a tally.
template <class Visit>
void for_each_number(const Domain& box, ImpactTally& tally, Visit&& visit) {
  for (Count* count : {&tally.collisions, &tally.wall_collisions, &tally.loads, &tally.wall_loads, &tally.inaccurate,
                       &tally.inaccurate_at_walls}) {
    auto number = static_cast<std::int64_t>(*count);
    visit(number);
    *count = static_cast<Count>(number);
  }
  for (std::int64_t& digit : tally.virial.digits()) visit(digit);
  if (box.shear.acts()) {
    tally.shear.resize(2);
    for (ExactSum& sum : tally.shear) {
      for (std::int64_t& digit : sum.digits()) visit(digit);
    }
  }
  if (box.inner_walls_move) {
    tally.pushes.resize(3);
    for (ExactSum& push : tally.pushes) {
      for (std::int64_t& digit : push.digits()) visit(digit);
    }
  }
  if (has_sinks(box)) {
    tally.absence.resize(1);
    for (std::int64_t& digit : tally.absence[0].digits()) visit(digit);
  }
  if (!box.has(SideKind::wall)) return;
  for (ExactSum& impulse : tally.wall_impulse) {
    for (std::int64_t& digit : impulse.digits()) visit(digit);
  }
  if (!box.has_moving_side() && !box.has_thermal_side()) return;
  tally.side_energy.resize(all_sides.size());
  for (ExactSum& energy : tally.side_energy) {
    for (std::int64_t& digit : energy.digits()) visit(digit);
  }
}

struct FiguresOverlaps {
  Overlap left, before, wall;
};

}  // namespace

void sum_over_ranks(Ranks& ranks, const Domain& box, ImpactTally& tally) {
  std::vector<std::int64_t> numbers;
  for_each_number(box, tally, [&](std::int64_t& number) { numbers.push_back(number); });
  ranks.sum(numbers);
  auto next = numbers.begin();
  for_each_number(box, tally, [&](std::int64_t& number) { number = *next++; });
}

void sum_counts_over_ranks(Ranks& ranks, std::vector<std::size_t>& count) {
  auto classes = static_cast<double>(count.size());
  ranks.maximum({&classes, 1});
  count.resize(static_cast<std::size_t>(classes), 0);
  std::vector<std::int64_t> numbers(count.begin(), count.end());
  ranks.sum(numbers);
  count.assign(numbers.begin(), numbers.end());
}

void count_taken_on_ranks(Ranks& ranks, SinkCounts taken, SinkCounts& all) {
  taken.resize(all.size());
  std::vector<std::int64_t> numbers(taken.begin(), taken.end());
  ranks.sum(numbers);
  add(all, SinkCounts(numbers.begin(), numbers.end()));
}

void join_over_ranks(Ranks& ranks, StepFigures& figures) {
  Bytes here;
  put(here, FiguresOverlaps{figures.left, figures.before, figures.wall});
  for (const Bytes& there : ranks.gather(here)) {
    const auto seen = MessageReader(there).get<FiguresOverlaps>();
    figures.left.raise_to(seen.left);
    figures.before.raise_to(seen.before);
    figures.wall.raise_to(seen.wall);
  }
}

}  // namespace carom
