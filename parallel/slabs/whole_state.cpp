#include "parallel/slabs/whole_state.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/border_search.hpp"
#include "parallel/slabs/id_pieces.hpp"
#include "parallel/slabs/moving_disks.hpp"

namespace carom {

namespace {

std::size_t piece_count(Ranks& ranks, const Disks& own) {
  double ids = own.id.empty() ? 0.0 : static_cast<double>(*std::max_element(own.id.begin(), own.id.end())) + 1.0;
  ranks.maximum({&ids, 1});
  return id_pieces(static_cast<std::size_t>(ids));
}

// All disks of a piece at the places of their ids, those that there are closed up.
void take_piece(const std::vector<Bytes>& messages, std::vector<Disk>& piece, std::vector<unsigned char>& there) {
  piece.resize(ids_a_piece);
  there.assign(ids_a_piece, 0);
  for (const Bytes& message : messages) {
    for (const Disk& disk : MessageReader(message).get_all<Disk>()) {
      const std::size_t at = disk.id & (ids_a_piece - 1);
      piece[at] = disk;
      there[at] = 1;
    }
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < ids_a_piece; ++k) {
    if (there[k] != 0) piece[kept++] = piece[k];
  }
  piece.resize(kept);
}

// How far a disk of any rank has left its slab; length.
double excursion_over_ranks(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own) {
  double furthest = 0.0;
  for (const double y : own.y) {
    const Beyond b = beyond(slab, box, y);
    if (slab.has_lower) furthest = std::max(furthest, b.lower);
    if (slab.has_upper) furthest = std::max(furthest, b.upper);
  }
  ranks.maximum({&furthest, 1});
  return furthest;
}

// The disks near the borders of a slab, on both sides of them: all pairs across one are among them.
Disks disks_at_borders(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own) {
  double largest = largest_radius(own);
  ranks.maximum({&largest, 1});
  const double excursion = excursion_over_ranks(ranks, slab, box, own);
  std::vector<std::uint32_t> all(own.size());
  std::iota(all.begin(), all.end(), 0U);
  SeenBeyond seen;
  find_seen_beyond(slab, box, own, all, largest, excursion, seen);
  Bytes to_below;
  Bytes to_above;
  put_all(to_below, seen.below);
  put_all(to_above, seen.above);
  const auto [below, above] = ranks.exchange(to_below, to_above);
  constexpr DiskColumns columns{true, true, false};
  Disks disks;
  for (const Disk& disk : seen.below) push_back(disks, disk, columns);
  for (const Disk& disk : seen.above) push_back(disks, disk, columns);
  for (const Bytes& message : {below, above}) {
    for (const Disk& disk : MessageReader(message).get_all<Disk>()) push_back(disks, disk, columns);
  }
  return disks;
}

}  // namespace

void visit_in_id_order(Ranks& ranks, const Disks& own, const std::function<void(const Disks&)>& use) {
  const std::size_t count = piece_count(ranks, own);
  const IdPieces pieces(own, count);
  const DiskColumns columns{true, true, own.spins()};
  std::vector<Disk> piece;
  std::vector<unsigned char> there;
  Disks some = no_disks_like(own);
  for (std::size_t p = 0; p < count; ++p) {
    piece.clear();
    for (const std::uint32_t i : pieces[p]) piece.push_back(disk_at(own, i));
    Bytes here;
    put_all(here, piece);
    const std::vector<Bytes> messages = ranks.collect(here);
    if (ranks.rank() > 0) continue;
    take_piece(messages, piece, there);
    truncate(some, 0);
    for (const Disk& disk : piece) push_back(some, disk, columns);
    use(some);
  }
}

StateSums sums_over_ranks(Ranks& ranks, const Scene& scene, const State& part) {
  StateTally tally(scene, part.time);
  std::vector<std::size_t> order;
  visit_in_id_order(ranks, part.disks, [&](const Disks& some) {
    order.resize(some.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    tally.add(some, order);
  });
  return tally.sums();
}

DeepestOverlaps overlaps_over_ranks(Ranks& ranks, const Scene& scene, const State& part, const SlabCut& cut) {
  DeepestOverlaps deepest = overlaps_of(part, scene);
  if (ranks.count() > 1) {
    const Domain box = box_at(scene.box, part.time);
    const Slab slab = slab_of(cut, box, ranks.rank());
    deepest.disks.see(deepest_overlap(disks_at_borders(ranks, slab, box, part.disks), box));
  }
  Bytes here;
  put(here, deepest);
  for (const Bytes& there : ranks.gather(here)) {
    const auto seen = MessageReader(there).get<DeepestOverlaps>();
    deepest.disks.see(seen.disks);
    deepest.wall.see(seen.wall);
  }
  return deepest;
}

}  // namespace carom
