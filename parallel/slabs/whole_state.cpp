#include "parallel/slabs/whole_state.hpp"

#include <numeric>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/border_disks.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/ordered_disks.hpp"

namespace carom {

namespace {

// The disks near the borders of a slab, on both sides of them: these include all pairs across a border.
Disks disks_at_borders(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own) {
  double largest = largest_radius(own);
  ranks.maximum({&largest, 1});
  const double excursion = excursion_over_ranks(ranks, slab, box, own);
  const BorderDisks disks = disks_at_borders(ranks, slab, box, own, largest, excursion);
  return joined(disks.own, disks.others);
}

}  // namespace

void visit_in_id_order(Ranks& ranks, const State& part, const std::function<void(const Disks&)>& use) {
  OrderedDisks disks(ranks, part.disks, part.next_id);
  for (std::size_t p = 0; p < disks.pieces(); ++p) {
    const Disks& some = disks.piece(p);
    if (ranks.rank() == 0) use(some);
  }
}

StateSums sums_over_ranks(Ranks& ranks, const Scene& scene, const State& part) {
  StateTally tally(scene, part.time);
  std::vector<std::size_t> order;
  visit_in_id_order(ranks, part, [&](const Disks& some) {
    order.resize(some.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    tally.add(some, order);
  });
  return tally.sums();
}

Overlap overlap_over_ranks(Ranks& ranks, const Domain& box, const Disks& own, const SlabCut& cut) {
  Overlap deepest = deepest_overlap(own, box);
  if (ranks.count() > 1) {
    const Slab slab = slab_of(cut, box, ranks.rank());
    deepest.raise_to(deepest_overlap(disks_at_borders(ranks, slab, box, own), box));
  }
  Bytes here;
  put(here, deepest);
  for (const Bytes& there : ranks.gather(here)) deepest.raise_to(MessageReader(there).get<Overlap>());
  return deepest;
}

DeepestOverlaps overlaps_over_ranks(Ranks& ranks, const Scene& scene, const State& part, const SlabCut& cut) {
  DeepestOverlaps deepest = overlaps_of(part, scene);
  if (ranks.count() > 1) {
    const Domain box = box_at(scene.box, part.time);
    const Slab slab = slab_of(cut, box, ranks.rank());
    deepest.disks.raise_to(deepest_overlap(disks_at_borders(ranks, slab, box, part.disks), box));
  }
  Bytes here;
  put(here, deepest);
  for (const Bytes& there : ranks.gather(here)) {
    const auto seen = MessageReader(there).get<DeepestOverlaps>();
    deepest.disks.raise_to(seen.disks);
    deepest.wall.raise_to(seen.wall);
  }
  return deepest;
}

}  // namespace carom
