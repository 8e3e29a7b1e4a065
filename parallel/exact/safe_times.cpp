#include "parallel/exact/safe_times.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

// A disk whose safe time proves to be later than it was due, by at least this share of the slice, is asked again;
// otherwise it is blocked.
constexpr double worthwhile_share = 1.0 / 16.0;

bool is_due_later(const SafeTimeDue& a, const SafeTimeDue& b) {
  return a.time > b.time;
}

}  // namespace

double SafeTimes::known_until(std::uint32_t unresolved) const {
  const DiskProgress progress = window_.record[unresolved].progress;
  return progress.is_blocked() ? worker_.blocked[progress.blocked()].safe_time : window_.slice_start;
}

// Before this time, no earlier than `time`, the unresolved disk cannot touch disk i on its present path; `never` if not
// within the slice.
double SafeTimes::safe_time_from(std::uint32_t i, double time, std::uint32_t unresolved) const {
  const DiskRecord& f = window_.record[i];
  const DiskRecord& u = window_.record[unresolved];
  const Gravity& g = window_.rules.gravity;
  const double until = known_until(unresolved);
  const double from = std::max(time, until);
  const PathSegment p = carried_to(f.path, from, g);
  const PathSegment q = carried_to(u.path, until, g);
  const Relative r = relative(p, q, window_.rules.box);
  // Both towards each other, since the motion of the unresolved one is unknown.
  const double speed =
      std::sqrt(f.path.vx * f.path.vx + f.path.vy * f.path.vy) + g.size * window_.length + window_.speed_bound;
  const double contact_distance = f.radius + u.radius + window_.slack + window_.speed_bound * (from - until);
  const double most = contact_distance + speed * (window_.slice_stop() - from);
  const double distance2 = r.distance2();
  if (distance2 > most * most * (1.0 + 1e-9)) return never;
  return from + std::max(std::sqrt(distance2) - contact_distance, 0.0) / speed;
}

SafeTimes::SafeTime SafeTimes::safe_time(std::uint32_t i, double time) const {
  SafeTime first;
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (window_.record[j].progress.is_active()) return;
    first.any = true;
    first.time = std::min(first.time, safe_time_from(i, time, j));
  });
  return first;
}

void SafeTimes::push_due(double time, std::uint32_t i) {
  if (!window_.in_slice(time)) return;
  worker_.safe_times.push_back({time, i});
  std::push_heap(worker_.safe_times.begin(), worker_.safe_times.end(), is_due_later);
}

void SafeTimes::mark_unresolved_neighbour(std::uint32_t i) {
  if (window_.record[i].progress.has(DiskProgress::has_unresolved_neighbour)) return;
  window_.record[i].progress.set(DiskProgress::has_unresolved_neighbour);
  worker_.marked.push_back(i);
}

void SafeTimes::push(std::uint32_t i, double time) {
  const SafeTime safe = safe_time(i, time);
  if (!safe.any) return;
  mark_unresolved_neighbour(i);
  push_due(safe.time, i);
}

void SafeTimes::reach_first() {
  const auto [time, i] = worker_.safe_times.front();
  std::pop_heap(worker_.safe_times.begin(), worker_.safe_times.end(), is_due_later);
  worker_.safe_times.pop_back();
  if (!window_.record[i].progress.is_active()) return;
  const SafeTime safe = safe_time(i, time);
  const double slice = window_.slice_stop() - window_.slice_start;
  if (safe.time <= time + worthwhile_share * slice) {
    block(i, time);
  } else {
    push_due(safe.time, i);
  }
}

void SafeTimes::block(std::uint32_t i, double time) {
  const std::uint32_t entry = i - worker_.region.first_disk;
  worker_.calendar.take_out(entry);
  window_.next_event_time[i] = worker_.calendar.time_of(entry);
  window_.record[i].progress.set_blocked(static_cast<std::uint32_t>(worker_.blocked.size()));
  worker_.blocked.push_back({i, time});
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (!window_.record[j].progress.is_active()) return;
    mark_unresolved_neighbour(j);
    push_due(safe_time_from(j, time, i), j);
  });
}

void SafeTimes::mark_relisted(std::uint32_t i) {
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (window_.record[j].progress.has(DiskProgress::at_border)) mark_lists_border(i);
  });
}

// Marks are set at once: the neighbours keep disk i in their lists, however soon it is relisted.
void SafeTimes::mark_relisted_at_border(std::uint32_t i) {
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (region_of(i) != region_of(j)) {
      mark_border(i);
      mark_border(j);
    }
    if (window_.record[j].progress.has(DiskProgress::at_border)) mark_lists_border(i);
    if (window_.record[i].progress.has(DiskProgress::at_border)) mark_lists_border(j);
  });
}

// From the next slice on: in this one a disk that was active goes on as it did.
void SafeTimes::mark_border(std::uint32_t i) {
  if (window_.record[i].progress.has(DiskProgress::at_border)) return;
  window_.record[i].progress.set(DiskProgress::at_border);
  worker_.border.push_back(i);
  lists_.for_each_neighbour(i, [&](std::uint32_t j) { mark_lists_border(j); });
}

void SafeTimes::mark_lists_border(std::uint32_t i) {
  if (window_.record[i].progress.has(DiskProgress::lists_border)) return;
  window_.record[i].progress.set(DiskProgress::lists_border);
  worker_.near_border.push_back(i);
}

}  // namespace carom
