#include "parallel/exact/exact_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "core/step/window_plan.hpp"

namespace carom {

void ExactSweep::begin_window(bool listed) {
  for (Region& region : regions_) region.part.begin_window();
  rest_.begin_window();
  rest_.lists = ListsPart{};
  if (!listed) return;
  listed_anew_ = 0;
  lay_out_regions();
}

// As many as threads, with about as many disks each.
void ExactSweep::lay_out_regions() {
  const std::size_t n = field_.flight.size();
  const std::uint32_t tiles = lists_.tiles();
  const std::size_t count = tiled() ? std::min<std::size_t>(static_cast<std::size_t>(executor_.threads()), tiles) : 0;
  regions_.resize(count);
  field_.region_of_tile.assign(tiles, 0);
  handed_on_.resize(tiles);
  field_.standing.assign(count > 0 ? n : 0, waiting);
  field_.mark.assign(count > 0 ? n : 0, 0);
  std::uint32_t tile = 0;
  for (std::size_t r = 0; r < count; ++r) {
    Region& region = regions_[r];
    region.part.begin_window();
    region.part.alone = false;
    region.first = tile;
    while (tile < tiles && (r + 1 == count || lists_.first_disk_of(tile) < n * (r + 1) / count)) {
      field_.region_of_tile[tile++] = static_cast<std::uint16_t>(r);
    }
    region.last = tile;
    region.part.lists = lists_.part_of_tiles(region.first, region.last);
  }
  executor_.run(count, [&](std::size_t r) { mark_edges(regions_[r]); });
  executor_.run(count, [&](std::size_t r) { mark_borders(regions_[r]); });
}

void ExactSweep::mark_edges(Region& region) {
  const ListsPart& part = region.part.lists;
  region.edge.clear();
  for (std::uint32_t i = part.first_disk; i < part.last_disk; ++i) {
    bool edge = false;
    lists_.for_each_neighbour(i, [&](std::uint32_t j) { edge = edge || !part.holds(j); });
    if (!edge) continue;
    field_.mark[i] |= at_edge;
    region.edge.push_back(i);
  }
}

void ExactSweep::mark_borders(Region& region) {
  for (std::uint32_t tile = region.first; tile < region.last; ++tile) {
    const ListsPart part = lists_.part_of_tiles(tile, tile + 1);
    for (std::uint32_t i = part.first_disk; i < part.last_disk; ++i) {
      if ((field_.mark[i] & at_edge) != 0) continue;
      bool border = false;
      lists_.for_each_neighbour(
          i, [&](std::uint32_t j) { border = border || j >= part.last_disk || (field_.mark[j] & at_edge) != 0; });
      if (border) field_.mark[i] |= at_border;
    }
  }
}

double ExactSweep::longest_slice() const {
  return tiled() ? 2.0 * (lists_.roam() - lists_.range()) / field_.bound : never;
}

SliceEnd ExactSweep::run(double start, double end, double expected, double window_start) {
  field_.slice_start = start;
  field_.slice_end = end;
  if (tiled()) {
    run_tiles(expected);
  } else {
    run_alone(expected);
  }
  const SliceEnd reached = end_of_slice();
  if (reached != SliceEnd::done) return reached;
  if (rest_.collapse && !tiled()) fail_collapse(*rest_.collapse, window_start);
  for (const Region& region : regions_) field_.fastest2 = std::max(field_.fastest2, region.part.fastest2);
  field_.fastest2 = std::max(field_.fastest2, rest_.fastest2);
  return SliceEnd::done;
}

SliceEnd ExactSweep::end_of_slice() const {
  bool is_void = false;
  bool crowded = false;
  bool given_up = false;
  bool collapsed = false;
  Count paths = 0;
  const auto see = [&](const ExactPart& part) {
    is_void = is_void || part.is_void;
    crowded = crowded || part.crowded;
    given_up = given_up || part.given_up;
    collapsed = collapsed || part.collapse;
    paths += part.paths;
  };
  for (const Region& region : regions_) see(region.part);
  see(rest_);
  if (given_up) return SliceEnd::given_up;
  if (is_void) return SliceEnd::too_fast;
  // Events pile up at one moment: which of them is the reference's first, tiles cannot tell.
  if (collapsed && tiled()) return SliceEnd::crowded;
  return crowded || paths > field_.most_paths ? SliceEnd::crowded : SliceEnd::done;
}

void ExactSweep::run_alone(double expected) {
  rest_.queue.begin(field_.slice_start, std::min(field_.slice_end, field_.length), static_cast<std::size_t>(expected));
  rest_.listed = 0;
  ExactEvents events(field_, lists_, rest_);
  for (std::uint32_t i = 0; i < field_.flight.size(); ++i) events.push_due(i);
  events.run();
  listed_anew_ += rest_.listed;
}

void ExactSweep::run_tiles(double expected) {
  const double each = expected / static_cast<double>(field_.flight.size());
  executor_.run(regions_.size(), [&](std::size_t r) { sweep_region(regions_[r], each); });
  for (const Region& region : regions_) {
    listed_anew_ += region.part.listed;
    if (region.part.ended) return;
  }
  run_rest(each);
}

// expected: events a disk.
void ExactSweep::sweep_region(Region& region, double expected) {
  const ListsPart& part = region.part.lists;
  std::fill(field_.standing.begin() + part.first_disk, field_.standing.begin() + part.last_disk, waiting);
  std::uint8_t* const mark = field_.mark.data();
  for (std::uint32_t i = part.first_disk; i < part.last_disk; ++i) mark[i] &= static_cast<std::uint8_t>(~wary);
  region.part.listed = 0;
  region.part.doubts.clear();
  region.left_over.clear();
  // A void window leaves some behind.
  for (std::uint32_t tile = region.first; tile < region.last; ++tile) handed_on_[tile].clear();
  ExactEvents events(field_, lists_, region.part);
  for (std::uint32_t tile = region.first; tile < region.last; ++tile) {
    if (region.part.ended) return;
    sweep_tile(region, events, tile, expected);
  }
}

void ExactSweep::sweep_tile(Region& region, ExactEvents& events, std::uint32_t tile, double expected) {
  const std::uint32_t first = lists_.first_disk_of(tile);
  const std::uint32_t last = lists_.first_disk_of(tile + 1);
  std::vector<Doubt>& doubts = region.part.doubts;
  std::vector<std::uint32_t>& handed_on = handed_on_[tile];
  const std::size_t before = doubts.size();
  const double disks = static_cast<double>(last - first) + static_cast<double>(handed_on.size());
  region.part.queue.begin(field_.slice_start, std::min(field_.slice_end, field_.length),
                          static_cast<std::size_t>(expected * disks));
  // The tile is looked at several times, in no order: asked for in order first, it comes much faster.
  for (std::uint32_t i = first; i < last; ++i) {
    __builtin_prefetch(&field_.flight[i]);
    lists_.prefetch(i);
  }
  const double most = std::min(field_.slice_end, field_.length);
  const double* const due = field_.due.data();
  std::uint32_t* const standing = field_.standing.data();
  const std::uint8_t* const mark = field_.mark.data();
  for (std::uint32_t i = first; i < last; ++i) standing[i] = (mark[i] & at_edge) != 0 ? waiting : at_hand;
  for (const std::uint32_t k : handed_on) standing[doubts[k].disk] = at_hand;
  for (std::uint32_t i = first; i < last; ++i) {
    if (standing[i] != at_hand) continue;
    if (due[i] <= most) events.push_due(i);
    if ((mark[i] & (at_border | wary)) != 0) events.watch(i, field_.slice_start);
  }
  for (const std::uint32_t k : handed_on) {
    events.push_due(doubts[k].disk);
    events.watch(doubts[k].disk, doubts[k].until);
  }
  events.run();
  const auto settle = [&](std::uint32_t i) { standing[i] = standing[i] == at_hand ? settled : standing[i]; };
  for (std::uint32_t i = first; i < last; ++i) settle(i);
  for (const std::uint32_t k : handed_on) settle(doubts[k].disk);
  for (std::size_t k = before; k < doubts.size(); ++k) {
    const std::uint32_t root = doubts[k].root;
    const bool later = root > tile && root < region.last;
    (later ? handed_on_[root] : region.left_over).push_back(static_cast<std::uint32_t>(k));
  }
}

void ExactSweep::run_rest(double expected) {
  rest_.listed = 0;
  rest_.edge.clear();
  std::size_t disks = 0;
  for (const Region& region : regions_) disks += region.edge.size() + region.left_over.size();
  if (disks == 0) return;
  rest_.queue.begin(field_.slice_start, std::min(field_.slice_end, field_.length),
                    static_cast<std::size_t>(expected * static_cast<double>(disks)));
  ExactEvents events(field_, lists_, rest_);
  for (const Region& region : regions_) {
    for (const std::uint32_t i : region.edge) events.push_due(i);
    for (const std::uint32_t k : region.left_over) events.push_due(region.part.doubts[k].disk);
  }
  events.run();
  for (const std::uint32_t i : rest_.edge) regions_[field_.region_of_tile[lists_.tile_of(i)]].edge.push_back(i);
  listed_anew_ += rest_.listed;
}

ImpactTally ExactSweep::tally() const {
  ImpactTally sum = rest_.tally;
  for (const Region& region : regions_) sum.add(region.part.tally);
  return sum;
}

Count ExactSweep::events() const {
  Count events = rest_.tally.collisions + rest_.tally.wall_collisions;
  for (const Region& region : regions_) events += region.part.tally.collisions + region.part.tally.wall_collisions;
  return events;
}

bool ExactSweep::any_gone() const {
  const auto gone = [](const Region& region) { return region.part.any_gone; };
  return rest_.any_gone || std::any_of(regions_.begin(), regions_.end(), gone);
}

}  // namespace carom
