#include "parallel/exact/slice_scheduler.hpp"

#include <algorithm>
#include <cmath>

#include "core/step/window_plan.hpp"

namespace carom {

namespace {

// The largest number of events per disk in a slice. With a smaller one, fewer events are left to the border pass; with
// a larger one, there are fewer passes.
constexpr double events_per_slice = 0.25;

}  // namespace

void SliceScheduler::begin_window(bool rebuilt, double per_disk) {
  for (Region& region : regions_) region.worker.begin_window();
  border_pass_.begin_window();
  single_.begin_window();
  single_.region = ListRegion{};
  others_.begin_window();
  if (rebuilt) {
    relisted_ = 0;
    lay_out_regions();
    slice_room_ = has_regions() ? lists_.skin() - lists_.relist_distance_near_border().length : never;
    if (ghosts_ != nullptr) {
      slice_room_ = ghosts_->least_of_all(slice_room_);
      mark_ghosts();
    }
  }
  if (ghosts_ == nullptr) return;
  const double slice = std::min(slice_end(window_.length, 0.0, per_disk), window_.length);
  window_.band = ghosts_->band(window_.speed_bound * slice);
  mark_edges();
}

// Gives each region about the same number of disks.
void SliceScheduler::lay_out_regions() {
  const std::size_t n = window_.record.size();
  const std::uint32_t tiles_a_layer = lists_.tiles_a_layer();
  const std::uint32_t layers = lists_.tiles() / tiles_a_layer;
  const std::size_t count = has_regions() ? std::min<std::size_t>(window_.regions, layers) : 0;
  regions_.resize(count);
  window_.region_of_tile.assign(lists_.tiles(), 0);
  const auto first_disk = [&](std::uint32_t layer) { return std::size_t{lists_.first_disk_of(layer * tiles_a_layer)}; };
  std::uint32_t layer = 0;
  for (std::size_t r = 0; r < count; ++r) {
    const std::uint32_t first = layer;
    // A layer goes to the region that would hold the greater part of it.
    while (layer < layers &&
           (r + 1 == count || (first_disk(layer) + first_disk(layer + 1)) / 2 < n * (r + 1) / count)) {
      ++layer;
    }
    const std::uint32_t first_tile = first * tiles_a_layer;
    const std::uint32_t last_tile = layer * tiles_a_layer;
    regions_[r].middle_tile = (first + (layer - first) / 2) * tiles_a_layer;
    std::fill(window_.region_of_tile.begin() + first_tile, window_.region_of_tile.begin() + last_tile,
              static_cast<std::uint16_t>(r));
    regions_[r].worker.number = r;
    regions_[r].worker.region = lists_.region_of_tiles(first_tile, last_tile);
    if (ghosts_ != nullptr) set_core_of_rank(regions_[r].worker.region);
    regions_[r].worker.begin_window();
    regions_[r].worker.begin_slice();  // a void window leaves blocked disks behind
  }
  border_pass_.lay_out(regions_);
  executor_.run(count, [&](std::size_t r) { find_border(regions_[r]); });
  executor_.run(count, [&](std::size_t r) { find_near_border(regions_[r]); });
}

// Ghosts may be at a border in any window, so they are relisted as early as disks near a border. Disks in the rank's
// own slab never are at one, since the window would be void.
void SliceScheduler::set_core_of_rank(ListRegion& region) const {
  const WindowGhosts::Heights own = ghosts_->own_heights();
  lists_.set_core_between(own.low, own.high, region);
}

void SliceScheduler::find_border(Region& region) {
  const ListRegion& disks = region.worker.region;
  region.border.clear();
  for (std::uint32_t i = disks.first_disk; i < disks.last_disk; ++i) {
    window_.record[i].progress = {};
    bool border = false;
    lists_.for_each_neighbour(i, [&](std::uint32_t j) { border = border || !disks.holds(j); });
    if (!border) continue;
    window_.record[i].progress.set(DiskProgress::at_border);
    window_.record[i].progress.set_border();
    region.border.push_back(i);
  }
}

void SliceScheduler::find_near_border(Region& region) {
  const ListRegion& disks = region.worker.region;
  region.near_border.clear();
  for (std::uint32_t i = disks.first_disk; i < disks.last_disk; ++i) {
    if (window_.record[i].progress.is_border()) continue;
    bool near = false;
    lists_.for_each_neighbour(i, [&](std::uint32_t j) { near = near || window_.record[j].progress.is_border(); });
    if (!near) continue;
    window_.record[i].progress.set(DiskProgress::lists_border);
    region.near_border.push_back(i);
  }
}

// A slice is so short that a disk at a border, which is not relisted before the slice's end, does not leave its skin;
// it begins the slice within the relist distance.
double SliceScheduler::longest_slice() const {
  return has_regions() ? slice_room_ / window_.speed_bound : never;
}

double SliceScheduler::slice_end(double length, double start, double per_disk) const {
  double longest = longest_slice();
  if (longest < never && per_disk > 0.0) longest = std::min(longest, events_per_slice / per_disk);
  const double left = length - start;
  const double parts = std::ceil(left / longest);
  return parts > 1.0 ? start + left / parts : never;
}

SliceOutcome SliceScheduler::run(double start, double end, double per_disk, double window_start) {
  window_.slice_start = start;
  window_.slice_end = end;
  if (ghosts_ != nullptr) return run_with_ghosts(per_disk);
  const Count before = events();
  if (has_regions()) {
    run_regions(per_disk);
  } else {
    run_single_queue(per_disk);
  }
  const SliceOutcome reached = outcome();
  if (reached != SliceOutcome::done) return reached;
  if (single_.collapse && !has_regions()) fail_collapse(window_.rules, *single_.collapse, window_start);
  for_each_worker([&](const Worker& worker) { window_.fastest2 = std::max(window_.fastest2, worker.fastest2); });
  events_of_slice_ = events() - before;
  return SliceOutcome::done;
}

void SliceScheduler::release_calendars() {
  for (Region& region : regions_) region.worker.calendar.release_memory();
  single_.calendar.release_memory();
}

SliceOutcome SliceScheduler::outcome() const {
  bool too_fast = false;
  bool crowded = false;
  bool given_up = false;
  bool collapsed = false;
  for_each_worker([&](const Worker& worker) {
    too_fast = too_fast || worker.too_fast;
    crowded = crowded || worker.crowded;
    given_up = given_up || worker.given_up;
    collapsed = collapsed || worker.collapse;
  });
  if (given_up) return SliceOutcome::given_up;
  if (too_fast) return SliceOutcome::too_fast;
  // If events pile up at one moment, regions and parts cannot tell at which of them the reference would stop.
  if (collapsed && (has_regions() || window_.is_part)) return SliceOutcome::crowded;
  return crowded || segments() > window_.most_paths ? SliceOutcome::crowded : SliceOutcome::done;
}

void SliceScheduler::run_single_queue(double per_disk) {
  single_.begin_slice();
  const auto run = [&](auto&& events) {
    if (window_.slice_start == 0.0) events.enter_all(per_disk * window_.length);
    events.run();
  };
  if (window_.is_part) {
    run(EventProcessor<Scope::part>(window_, lists_, single_));
  } else {
    run(EventProcessor<Scope::all>(window_, lists_, single_));
  }
  relisted_ += single_.relisted;
}

void SliceScheduler::replace_paths(const std::vector<std::uint32_t>& disks) {
  EventProcessor<Scope::part> events(window_, lists_, single_);
  for (const std::uint32_t i : disks) events.replace_path(i);
}

void SliceScheduler::run_regions(double per_disk) {
  executor_.run(regions_.size(), [&](std::size_t r) { run_region(regions_[r], per_disk); });
  for (const Region& region : regions_) {
    relisted_ += region.worker.relisted;
    if (region.worker.ended) return;
    window_.fastest2 = std::max(window_.fastest2, region.worker.fastest2);
  }
  border_pass_.run(regions_, per_disk);
  if (border_pass_.ended()) return;
  relisted_ += border_pass_.relisted();
  if (watch_) show_borders();
  executor_.run(regions_.size(), [&](std::size_t r) { finish_slice(regions_[r]); });
  take_in_new_border(border_pass_.new_border(), border_pass_.new_near_border());
}

// The same on one of several ranks. No rank returns before all know the slice's outcome on each.
SliceOutcome SliceScheduler::run_with_ghosts(double per_disk) {
  const Count before = events();
  Region& region = regions_.front();
  const bool near = ghosts_->strangers_come_near(window_);
  run_region(region, per_disk);
  relisted_ += region.worker.relisted;
  window_.fastest2 = std::max(window_.fastest2, region.worker.fastest2);
  SliceOutcome here = outcome();
  if (here == SliceOutcome::done && depends_on_others()) here = SliceOutcome::ghosts_too_few;
  if (near) here = SliceOutcome::strangers_too_near;
  events_of_slice_ = events() - before;
  const SliceOutcome reached = ghosts_->agree(here, events_of_slice_);
  if (reached != SliceOutcome::done) return reached;
  unknown_ = region.border;
  for (const BlockedDisk& blocked : region.worker.blocked) unknown_.push_back(blocked.disk);
  ghosts_->learn(window_, unknown_);
  see_slice_of_others();
  finish_slice(region);
  take_in_new_border(others_.border, others_.near_border);
  relisted_ += others_.relisted;
  return SliceOutcome::done;
}

// Does the motion of an own disk up to the slice's end depend on disks that this rank does not have? Or that of any
// disk in the rank's slab, from the slice's start on? Such a disk could leave its skin.
bool SliceScheduler::depends_on_others() const {
  const auto is_own = [this](std::uint32_t i) { return !window_.record[i].progress.has(DiskProgress::ghost); };
  const Region& region = regions_.front();
  const auto must_be_known = [&](std::uint32_t i) { return is_own(i) || lists_.is_in_core(i, region.worker.region); };
  return std::any_of(region.border.begin(), region.border.end(), must_be_known) ||
         std::any_of(region.worker.blocked.begin(), region.worker.blocked.end(),
                     [&](const BlockedDisk& blocked) { return is_own(blocked.disk); });
}

// All paths are now those at the slice's end. First the disks that have moved too far are relisted, then the events of
// the blocked disks are predicted.
void SliceScheduler::see_slice_of_others() {
  others_.begin_slice();
  others_.region = ListRegion{};
  EventProcessor<Scope::border> events(window_, lists_, others_);
  const std::vector<BlockedDisk>& blocked = regions_.front().worker.blocked;
  for (const std::uint32_t i : unknown_) {
    if (std::isnan(window_.record[i].path.x)) others_.any_gone = true;
    events.relist_if_due(i);
  }
  for (const BlockedDisk& b : blocked) events.predict_next_slice(b.disk);
}

void SliceScheduler::mark_ghosts() {
  for (std::uint32_t i = 0; i < window_.record.size(); ++i) {
    if (ghosts_->is_ghost(i)) window_.record[i].progress.set(DiskProgress::ghost);
  }
}

// Disks that may meet in this window one that the rank does not have are at a border, too.
void SliceScheduler::mark_edges() {
  Region& region = regions_.front();
  for (std::uint32_t i = 0; i < window_.record.size(); ++i) {
    DiskRecord& record = window_.record[i];
    if (record.progress.is_border() || !window_.is_beyond_band(i, lists_.listed_position(i).y, lists_.skin())) continue;
    record.progress.set(DiskProgress::at_border);
    record.progress.set_border();
    region.border.push_back(i);
    lists_.for_each_neighbour(i, [&](std::uint32_t j) {
      if (window_.record[j].progress.has(DiskProgress::lists_border)) return;
      window_.record[j].progress.set(DiskProgress::lists_border);
      region.near_border.push_back(j);
    });
  }
}

void SliceScheduler::run_region(Region& region, double per_disk) {
  begin_slice(region);
  EventProcessor<Scope::region> events(window_, lists_, region.worker);
  if (window_.slice_start == 0.0) events.enter_all(per_disk * window_.length);
  for (const std::uint32_t i : region.near_border) {
    if (window_.record[i].progress.is_active()) events.push_safe_time(i);
  }
  events.run();
}

void SliceScheduler::begin_slice(Region& region) {
  for (const std::uint32_t i : region.worker.marked) {
    window_.record[i].progress.clear(DiskProgress::has_unresolved_neighbour);
  }
  region.worker.begin_slice();
}

// Disks that were blocked become active in their region again.
void SliceScheduler::finish_slice(Region& region) {
  EventProcessor<Scope::region> events(window_, lists_, region.worker);
  for (const BlockedDisk& blocked : region.worker.blocked) {
    window_.record[blocked.disk].progress.set_active();
    events.enter(blocked.disk);
  }
  region.near_border.insert(region.near_border.end(), region.worker.near_border.begin(),
                            region.worker.near_border.end());
}

// A disk that was not near a border may have moved further than is allowed there, and is then relisted. That may bring
// other disks to the border, or near it, so both lists may grow on the way.
void SliceScheduler::take_in_new_border(const std::vector<std::uint32_t>& border,
                                        const std::vector<std::uint32_t>& near_border) {
  std::size_t at = 0;
  std::size_t near = 0;
  while (at < border.size() || near < near_border.size()) {
    if (at < border.size()) {
      take_in_border(border[at++]);
    } else {
      take_in_near_border(near_border[near++]);
    }
  }
}

void SliceScheduler::take_in_border(std::uint32_t i) {
  Region& region = region_of(i);
  region.worker.calendar.take_out(i);
  window_.record[i].progress.set_border();
  region.border.push_back(i);
  if (ghosts_ == nullptr) border_pass_.relist_if_far(i);
}

// With ghosts, a disk near a border is relisted within the slice, before it is blocked if necessary.
void SliceScheduler::take_in_near_border(std::uint32_t i) {
  Region& region = region_of(i);
  region.near_border.push_back(i);
  if (ghosts_ != nullptr || !window_.record[i].progress.is_active()) return;
  border_pass_.relist_if_far(i);
  EventProcessor<Scope::region>(window_, lists_, region.worker).enter(i);
}

void SliceScheduler::show_borders() const {
  const auto events_of = [](const Worker& worker) { return worker.tally.collisions + worker.tally.wall_collisions; };
  Count at_borders = 0;
  border_pass_.for_each_worker([&](const Worker& worker) { at_borders += events_of(worker); });
  watch_({window_, lists_, regions_, events(), at_borders});
}

ImpactTally SliceScheduler::tally() const {
  ImpactTally sum;
  for_each_worker([&](const Worker& worker) { sum.add(worker.tally); });
  return sum;
}

Count SliceScheduler::segments() const {
  Count segments = 0;
  for_each_worker([&](const Worker& worker) { segments += worker.segments; });
  return segments;
}

Count SliceScheduler::events() const {
  Count events = 0;
  for_each_worker([&](const Worker& worker) { events += worker.tally.collisions + worker.tally.wall_collisions; });
  return events;
}

bool SliceScheduler::any_gone() const {
  bool any = false;
  for_each_worker([&](const Worker& worker) { any = any || worker.any_gone; });
  return any;
}

}  // namespace carom
