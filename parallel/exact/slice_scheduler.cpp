#include "parallel/exact/slice_scheduler.hpp"

#include <algorithm>
#include <cmath>

#include "core/step/window_plan.hpp"

namespace carom {

void SliceScheduler::begin_window(bool rebuilt) {
  for (Region& region : regions_) region.worker.begin_window();
  serial_.begin_window();
  serial_.region = ListRegion{};
  if (!rebuilt) return;
  relisted_ = 0;
  lay_out_regions();
}

// As many as threads, with about as many disks each.
void SliceScheduler::lay_out_regions() {
  const std::size_t n = window_.record.size();
  const std::uint32_t tiles = lists_.tiles();
  const std::size_t count = tiled() ? std::min<std::size_t>(static_cast<std::size_t>(executor_.threads()), tiles) : 0;
  regions_.resize(count);
  window_.region_of_tile.assign(tiles, 0);
  forwarded_.resize(tiles);
  window_.progress.assign(count > 0 ? n : 0, DiskProgress::pending());
  window_.mark.assign(count > 0 ? n : 0, 0);
  std::uint32_t tile = 0;
  for (std::size_t r = 0; r < count; ++r) {
    Region& region = regions_[r];
    region.worker.begin_window();
    region.worker.is_serial = false;
    region.first = tile;
    while (tile < tiles && (r + 1 == count || lists_.first_disk_of(tile) < n * (r + 1) / count)) {
      window_.region_of_tile[tile++] = static_cast<std::uint16_t>(r);
    }
    region.last = tile;
    region.worker.region = lists_.region_of_tiles(region.first, region.last);
  }
  executor_.run(count, [&](std::size_t r) { find_border(regions_[r]); });
  executor_.run(count, [&](std::size_t r) { find_later_tiles(regions_[r]); });
}

void SliceScheduler::find_border(Region& region) {
  const ListRegion& disks = region.worker.region;
  region.border.clear();
  for (std::uint32_t i = disks.first_disk; i < disks.last_disk; ++i) {
    bool border = false;
    lists_.for_each_neighbour(i, [&](std::uint32_t j) { border = border || !disks.holds(j); });
    if (!border) continue;
    window_.mark[i] |= lists_other_region;
    region.border.push_back(i);
  }
}

void SliceScheduler::find_later_tiles(Region& region) {
  const auto& mark = window_.mark;
  for (std::uint32_t tile = region.first; tile < region.last; ++tile) {
    const ListRegion disks = lists_.region_of_tiles(tile, tile + 1);
    for (std::uint32_t i = disks.first_disk; i < disks.last_disk; ++i) {
      if ((mark[i] & lists_other_region) != 0) continue;
      bool later = false;
      lists_.for_each_neighbour(
          i, [&](std::uint32_t j) { later = later || j >= disks.last_disk || (mark[j] & lists_other_region) != 0; });
      if (later) window_.mark[i] |= lists_later_tile;
    }
  }
}

// Two disks that do not list each other cannot touch unless together they move by twice the skin. A disk that is
// resolved moves by no more than the relist distance, one that is not by no more than that and what it covers in the
// slice.
double SliceScheduler::longest_slice() const {
  return tiled() ? 2.0 * (lists_.skin() - lists_.relist_distance()) / window_.speed_bound : never;
}

SliceOutcome SliceScheduler::run(double start, double end, double expected, double window_start) {
  window_.slice_start = start;
  window_.slice_end = end;
  if (tiled()) {
    run_tiles(expected);
  } else {
    run_single_queue(expected);
  }
  const SliceOutcome reached = outcome();
  if (reached != SliceOutcome::done) return reached;
  if (serial_.collapse && !tiled()) fail_collapse(*serial_.collapse, window_start);
  window_.fastest2 = std::max(window_.fastest2, serial_.fastest2);
  return SliceOutcome::done;
}

SliceOutcome SliceScheduler::outcome() const {
  bool too_fast = false;
  bool crowded = false;
  bool given_up = false;
  bool collapsed = false;
  Count segments = 0;
  const auto see = [&](const Worker& worker) {
    too_fast = too_fast || worker.too_fast;
    crowded = crowded || worker.crowded;
    given_up = given_up || worker.given_up;
    collapsed = collapsed || worker.collapse;
    segments += worker.segments;
  };
  for (const Region& region : regions_) see(region.worker);
  see(serial_);
  if (given_up) return SliceOutcome::given_up;
  if (too_fast) return SliceOutcome::too_fast;
  // Events pile up at one moment: which of them is the reference's first, tiles cannot tell.
  if (collapsed && tiled()) return SliceOutcome::crowded;
  return crowded || segments > window_.most_paths ? SliceOutcome::crowded : SliceOutcome::done;
}

void SliceScheduler::begin_queue(Worker& worker, double expected) {
  worker.queue.begin(window_.slice_start, window_.slice_stop(), static_cast<std::size_t>(expected));
}

void SliceScheduler::run_single_queue(double expected) {
  serial_.relisted = 0;
  EventProcessor<false> events(window_, lists_, serial_);
  events.enter_all(static_cast<std::size_t>(expected));
  events.run();
  events.leave_all();
  relisted_ += serial_.relisted;
}

void SliceScheduler::run_tiles(double expected) {
  const double per_disk = expected / static_cast<double>(window_.record.size());
  executor_.run(regions_.size(), [&](std::size_t r) { run_region(regions_[r], per_disk); });
  for (const Region& region : regions_) {
    relisted_ += region.worker.relisted;
    if (region.worker.ended) return;
    window_.fastest2 = std::max(window_.fastest2, region.worker.fastest2);
  }
  run_serial_pass(per_disk);
}

void SliceScheduler::begin_slice(Region& region) {
  const ListRegion& disks = region.worker.region;
  std::fill(window_.progress.begin() + disks.first_disk, window_.progress.begin() + disks.last_disk,
            DiskProgress::pending());
  std::uint8_t* const mark = window_.mark.data();
  for (std::uint32_t i = disks.first_disk; i < disks.last_disk; ++i) {
    mark[i] &= static_cast<std::uint8_t>(~has_unresolved_neighbour);
  }
  region.worker.relisted = 0;
  region.worker.blocked.clear();
  region.deferred.clear();
  // A void window leaves some behind.
  for (std::uint32_t tile = region.first; tile < region.last; ++tile) forwarded_[tile].clear();
}

// expected: events a disk.
void SliceScheduler::run_region(Region& region, double expected) {
  begin_slice(region);
  EventProcessor<true> events(window_, lists_, region.worker);
  for (std::uint32_t tile = region.first; tile < region.last && !region.worker.ended; ++tile) {
    const std::size_t first_blocked = region.worker.blocked.size();
    begin_tile(region, tile, expected);
    activate(tile, region.worker.blocked);
    queue_tile(tile, region.worker.blocked, events);
    events.run();
    finish_tile(region, tile, first_blocked);
  }
}

// The tile is visited several times, in no order: prefetched in order first, it comes much faster.
void SliceScheduler::begin_tile(Region& region, std::uint32_t tile, double expected) {
  const std::uint32_t first = lists_.first_disk_of(tile);
  const std::uint32_t last = lists_.first_disk_of(tile + 1);
  const double disks = static_cast<double>(last - first) + static_cast<double>(forwarded_[tile].size());
  begin_queue(region.worker, expected * disks);
  const DiskRecord* const record = window_.record.data();
  for (std::uint32_t i = first; i < last; ++i) __builtin_prefetch(record + i);
  lists_.prefetch(first, last);
}

void SliceScheduler::activate(std::uint32_t tile, const std::vector<BlockedDisk>& blocked) {
  const std::uint32_t last = lists_.first_disk_of(tile + 1);
  DiskProgress* const progress = window_.progress.data();
  const std::uint8_t* const mark = window_.mark.data();
  for (std::uint32_t i = lists_.first_disk_of(tile); i < last; ++i) {
    progress[i] = (mark[i] & lists_other_region) != 0 ? DiskProgress::pending() : DiskProgress::active();
  }
  for (const std::uint32_t k : forwarded_[tile]) progress[blocked[k].disk] = DiskProgress::active();
}

void SliceScheduler::queue_tile(std::uint32_t tile, const std::vector<BlockedDisk>& blocked,
                                EventProcessor<true>& events) {
  const std::uint32_t last = lists_.first_disk_of(tile + 1);
  const double stop = window_.slice_stop();
  const double* const next_event_time = window_.next_event_time.data();
  const DiskProgress* const progress = window_.progress.data();
  const std::uint8_t* const mark = window_.mark.data();
  for (std::uint32_t i = lists_.first_disk_of(tile); i < last; ++i) {
    if (!progress[i].is(Progress::active)) continue;
    if (next_event_time[i] <= stop) events.push_next_event(i);
    if ((mark[i] & (lists_later_tile | has_unresolved_neighbour)) != 0) events.push_safe_time(i, window_.slice_start);
  }
  for (const std::uint32_t k : forwarded_[tile]) {
    events.push_next_event(blocked[k].disk);
    events.push_safe_time(blocked[k].disk, blocked[k].safe_time);
  }
}

// Disks that are still active are done; those that were blocked, from number first_blocked on, go to the tile that
// blocks them.
void SliceScheduler::finish_tile(Region& region, std::uint32_t tile, std::size_t first_blocked) {
  const std::vector<BlockedDisk>& blocked = region.worker.blocked;
  DiskProgress* const progress = window_.progress.data();
  const std::uint32_t last = lists_.first_disk_of(tile + 1);
  for (std::uint32_t i = lists_.first_disk_of(tile); i < last; ++i) progress[i] = progress[i].finished();
  for (const std::uint32_t k : forwarded_[tile]) progress[blocked[k].disk] = progress[blocked[k].disk].finished();
  for (std::size_t k = first_blocked; k < blocked.size(); ++k) {
    const bool later = blocked[k].tile > tile && blocked[k].tile < region.last;
    (later ? forwarded_[blocked[k].tile] : region.deferred).push_back(static_cast<std::uint32_t>(k));
  }
}

// The disks of the region borders and those deferred; all others are done.
void SliceScheduler::run_serial_pass(double expected) {
  serial_.relisted = 0;
  serial_.border.clear();
  std::size_t disks = 0;
  for (const Region& region : regions_) disks += region.border.size() + region.deferred.size();
  if (disks == 0) return;
  begin_queue(serial_, expected * static_cast<double>(disks));
  EventProcessor<true> events(window_, lists_, serial_);
  for (const Region& region : regions_) {
    for (const std::uint32_t i : region.border) events.push_next_event(i);
    for (const std::uint32_t k : region.deferred) events.push_next_event(region.worker.blocked[k].disk);
  }
  events.run();
  for (const std::uint32_t i : serial_.border) regions_[window_.region_of_tile[lists_.tile_of(i)]].border.push_back(i);
  relisted_ += serial_.relisted;
}

ImpactTally SliceScheduler::tally() const {
  ImpactTally sum = serial_.tally;
  for (const Region& region : regions_) sum.add(region.worker.tally);
  return sum;
}

Count SliceScheduler::events() const {
  Count events = serial_.tally.collisions + serial_.tally.wall_collisions;
  for (const Region& region : regions_) events += region.worker.tally.collisions + region.worker.tally.wall_collisions;
  return events;
}

bool SliceScheduler::any_gone() const {
  const auto gone = [](const Region& region) { return region.worker.any_gone; };
  return serial_.any_gone || std::any_of(regions_.begin(), regions_.end(), gone);
}

}  // namespace carom
