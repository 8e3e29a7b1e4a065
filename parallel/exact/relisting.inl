// When disks are relisted: a part of EventProcessor. Included only by event_processor.cpp, so that it is inlined there.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "parallel/exact/event_processor.hpp"

namespace carom {

template <Scope scope>
inline bool EventProcessor<scope>::relist_at(std::uint32_t i, double time, Vec2 at) {
  if (scope == Scope::region && window_.is_beyond_band(i, at.y, lists_.skin())) return false;
  const Disks& d = *window_.disks;
  if (!lists_.find_list(i, at, d, worker_.region, worker_.found)) return false;
  if (window_.looks_ahead) {
    // The disks that are new in the list have not been read yet; they are prefetched while rows change.
    for (const std::uint32_t j : worker_.found.disks()) __builtin_prefetch(&record_[j]);
  }
  if (!lists_.take_list(i, d, worker_.region, worker_.found)) return false;
  ++worker_.relisted;
  if (window_.depth_beyond_borders.load(std::memory_order_relaxed) > 0.0) [[unlikely]]
    look_beyond_border(i, at);
  if constexpr (scope == Scope::region) safe_times_.mark_relisted(i, time);
  if constexpr (scope == Scope::part) note_listing(i);
  return true;
}

template <Scope scope>
void EventProcessor<scope>::relist_and_predict(std::uint32_t i, double time) {
  if (scope == Scope::border || relist(i, time, relist_distance(i))) {
    predict_next_event<false>(i, time);
  } else {
    block(i, time);
  }
}

// Near borders disks are relisted earlier, since relisting may have to wait for a slice's end. With one queue there are
// no borders.
template <Scope scope>
inline bool EventProcessor<scope>::is_near_border(std::uint32_t i) const {
  if (scope != Scope::region) return has_regions;
  return record_[i].progress.is_near_border() || !lists_.is_in_core(i, worker_.region);
}

// Does the disk, whose motion from now on is not known, stay within its skin to the end of the slice?
template <Scope scope>
bool EventProcessor<scope>::stays_in_skin(std::uint32_t i, double time) const {
  const PathSegment p = carried_to(record_[i].path, time, window_.rules.gravity);
  return lists_.stays_in_skin(i, p.x, p.y, window_.speed_bound * (window_.slice_stop() - time));
}

// Region: the disk's further events, and its relisting, wait for the border pass. So the disk is relisted now if it
// could leave its skin before the slice's end. If this thread cannot do that, the window is void, and is run again with
// new lists and shorter slices.
template <Scope scope>
void EventProcessor<scope>::block(std::uint32_t i, double time) {
  if (!stays_in_skin(i, time)) [[unlikely]] {
    const bool listed = relist(i, time, lists_.relist_distance_near_border()) || relist_a_little(i, time);
    if (!listed || !stays_in_skin(i, time)) worker_.too_fast = worker_.ended = true;
    predict_next_event<false>(i, time);
  }
  safe_times_.block(i, time);
}

// If the disk cannot be listed at its place, its listed position is moved only as far as necessary.
template <Scope scope>
bool EventProcessor<scope>::relist_a_little(std::uint32_t i, double time) {
  PathSegment p = carried_to(record_[i].path, time, window_.rules.gravity);
  const Vec2 listed = lists_.listed_position(i);
  const Vec2 back = nearest_image_at_rest({listed.x - p.x, listed.y - p.y}, window_.rules.box);
  const double distance = std::sqrt(back.x * back.x + back.y * back.y);
  const double room = lists_.skin() - window_.speed_bound * (window_.slice_stop() - time);
  const double share = std::clamp(0.99 * room / distance, 0.0, 1.0);
  p.x += share * back.x;
  p.y += share * back.y;
  wrap_into(p, window_.rules.box);
  if (!relist_at(i, time, {p.x, p.y})) return false;
  show_images_if_far(i, time);
  return true;
}

template <Scope scope>
void EventProcessor<scope>::put_off_relisting(std::uint32_t i) {
  if (record_[i].progress.has(DiskProgress::relists_late)) return;
  record_[i].progress.set(DiskProgress::relists_late);
  worker_.late.push_back(i);
}

template <Scope scope>
void EventProcessor<scope>::relist_late(const std::vector<std::uint32_t>& disks) {
  for (const std::uint32_t i : disks) {
    DiskRecord& record = record_[i];
    if (!record.progress.has(DiskProgress::relists_late)) continue;
    const bool gone = std::isnan(record.path.x);
    if (!gone && !relist(i, window_.slice_stop(), relist_distance(i))) continue;
    record.progress.clear(DiskProgress::relists_late);
    if (!gone) predict_next_slice(i);
  }
}

template <Scope scope>
void EventProcessor<scope>::relist_if_due(std::uint32_t i) {
  const double now = window_.slice_stop();
  if (std::isnan(record_[i].path.x)) return;
  const RelistDistance& distance = relist_distance(i);
  show_images_if_far(i, now);
  if (lists_.earliest_relist_time(i, record_[i].path, now, now, window_.rules.gravity, distance) > now) return;
  relist(i, now, distance);
  mark_relisted(i);
}

template <Scope scope>
void EventProcessor<scope>::relist_if_far(std::uint32_t i) {
  const PathSegment p = carried_to(record_[i].path, window_.slice_stop(), window_.rules.gravity);
  if (std::isnan(p.x)) return;
  const double rest = lists_.skin() - lists_.relist_distance_near_border().length;
  const bool is_far = !lists_.stays_in_skin(i, p.x, p.y, rest);
  if (is_far) relist(i, window_.slice_stop(), relist_distance(i));
  predict_next_slice(i);
  if (is_far) mark_relisted(i);
}

// Returns false, without a change, if relisting would change lists of another region or bring the disk to a border.
template <Scope scope>
bool EventProcessor<scope>::relist(std::uint32_t i, double time, const RelistDistance& ahead) {
  const PathSegment p = carried_to(record_[i].path, time, window_.rules.gravity);
  // A disk whose path has left the box looks for images already: it was listed near the border when it left.
  const bool outside = !lists_.rows().row(i).is_inside() && lists_.is_outside(p.x, p.y);
  if (!relist_at(i, time, lists_.listing_place(p, window_.rules.box, ahead))) return false;
  if (outside) [[unlikely]]
    show_images_if_far(i, time);
  return true;
}

// Acts only if the disk's path has left the box and leads far into it from the other side: the disk and its neighbours
// then look for images, and so must disks that are relisted at such a depth in the rest of the window.
template <Scope scope>
void EventProcessor<scope>::show_images_if_far(std::uint32_t i, double time) {
  const PathSegment p = carried_to(record_[i].path, time, window_.rules.gravity);
  const double depth = lists_.depth_beyond_border(p, lists_.listed_position(i));
  if (!(depth > 0.0)) return;
  std::atomic<double>& deepest = window_.depth_beyond_borders;
  double before = deepest.load(std::memory_order_relaxed);
  while (before < depth && !deepest.compare_exchange_weak(before, depth, std::memory_order_relaxed)) {
  }
  lists_.look_for_images(i);
  lists_.for_each_neighbour(i, [&](std::uint32_t j) { lists_.look_for_images(j); });
}

template <Scope scope>
void EventProcessor<scope>::look_beyond_border(std::uint32_t i, Vec2 at) {
  const double depth = window_.depth_beyond_borders.load(std::memory_order_relaxed);
  if (lists_.may_list_at_depth(at, depth)) lists_.look_for_images(i);
}

// Part: if an own disk may come beyond an end of the part before it is relisted, the part there must have it as a
// ghost.
template <Scope scope>
void EventProcessor<scope>::note_listing(std::uint32_t i) {
  const double distance = lists_.skin() + window_.slack;
  if (!window_.part.note_listing(lists_.listed_position(i), distance, record_[i], window_.others[i])) [[unlikely]]
    worker_.too_fast = worker_.ended = true;
}

}  // namespace carom
