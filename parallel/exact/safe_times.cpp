#include "parallel/exact/safe_times.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

// If a safe time that has come proves to be later by more than this share of the slice, the disk goes on until then;
// otherwise it is blocked.
constexpr double worthwhile_share = 1.0 / 16.0;

bool is_due_later(const SafeTimeDue& a, const SafeTimeDue& b) {
  return a.time > b.time;
}

}  // namespace

inline SafeTimes::Place SafeTimes::place_at(std::uint32_t i, double time) const {
  const DiskRecord& f = window_.record[i];
  const Gravity& g = window_.rules.gravity;
  const double s = time - f.path.start;
  double x = f.path.x + f.path.vx * s;
  double y = f.path.y + f.path.vy * s;
  if (g.acts()) {
    x -= 0.5 * g.left * (s * s);
    y -= 0.5 * g.down * (s * s);
  }
  return {time, x, y, f.radius};
}

// inside: no image of b is nearer than b itself (ListRow::is_inside).
inline double SafeTimes::distance2(const Place& a, const Place& b, bool inside) const {
  Vec2 apart{b.x - a.x, b.y - a.y};
  if (!inside) [[unlikely]]
    apart = nearest_image_at_rest(apart, window_.rules.box);
  return apart.x * apart.x + apart.y * apart.y;
}

// The largest speed at which disk i and a disk whose motion is not known can approach each other.
double SafeTimes::closing_speed(std::uint32_t i) const {
  const PathSegment& p = window_.record[i].path;
  return std::sqrt(p.vx * p.vx + p.vy * p.vy) + window_.rules.gravity.size * window_.length + window_.speed_bound;
}

// The safe time of disk i on its present path, at least `time`; `never` if it is not within the slice. Most neighbours
// are too far away to touch it within the slice, which the square of the distance shows.
SafeTimes::SafeTime SafeTimes::safe_time(std::uint32_t i, double time) const {
  SafeTime first;
  const DiskRecord* const record = window_.record.data();
  const Place own = place_at(i, time);
  const double speed = closing_speed(i);
  const bool inside = lists_.rows().row(i).is_inside();
  const double reach = (own.radius + window_.slack + speed * (window_.slice_stop() - time)) * (1.0 + 1e-9);
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    const DiskProgress progress = record[j].progress;
    if (progress.is_active()) return;
    first.any = true;
    const double until = progress.is_blocked() ? worker_.blocked[progress.blocked()].safe_time : window_.slice_start;
    const Place other = place_at(j, until);
    const double since = window_.speed_bound * std::max(time - until, 0.0);
    const double d2 = distance2(own, other, inside);
    const double most = reach + (other.radius + since) * (1.0 + 1e-9);
    if (d2 > most * most) return;
    const double gap = std::sqrt(d2) - (own.radius + other.radius + window_.slack + since);
    first.time = std::min(first.time, time + std::max(gap, 0.0) / speed);
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

bool SafeTimes::reach_first(SafeTimeDue& due) {
  due = worker_.safe_times.front();
  const auto [time, i] = due;
  std::pop_heap(worker_.safe_times.begin(), worker_.safe_times.end(), is_due_later);
  worker_.safe_times.pop_back();
  if (!window_.record[i].progress.is_active()) return false;
  const SafeTime safe = safe_time(i, time);
  const double slice = window_.slice_stop() - window_.slice_start;
  if (safe.time <= time + worthwhile_share * slice) return true;
  push_due(safe.time, i);
  return false;
}

void SafeTimes::block(std::uint32_t i, double time) {
  worker_.calendar.take_out(i);
  window_.record[i].progress.set_blocked(static_cast<std::uint32_t>(worker_.blocked.size()));
  worker_.blocked.push_back({i, time});
  const Place own = place_at(i, time);
  const bool inside = lists_.rows().row(i).is_inside();
  const double left = window_.slice_stop() - time;
  const double room = own.radius + window_.slack + 2.0 * window_.speed_bound * left;
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (!window_.record[j].progress.is_active()) return;
    mark_unresolved_neighbour(j);
    const Place other = place_at(j, time);
    const double d2 = distance2(own, other, inside);
    const double most = (room + other.radius) * (1.0 + 1e-9);
    if (d2 > most * most) return;
    const double gap = std::sqrt(d2) - (own.radius + other.radius + window_.slack);
    push_due(time + std::max(gap, 0.0) / closing_speed(j), j);
  });
}

void SafeTimes::mark_relisted(std::uint32_t i, double time) {
  bool any = false;
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    const DiskProgress progress = window_.record[j].progress;
    any = any || !progress.is_active();
    if (progress.has(DiskProgress::at_border)) mark_lists_border(i);
  });
  if (any) push(i, time);
}

// Marks are set at once: the neighbours keep disk i in their lists, however soon it is relisted.
void SafeTimes::mark_relisted_at_border(std::uint32_t i) {
  if (window_.is_beyond_band(i, lists_.listed_position(i).y, lists_.skin())) mark_border(i);
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (region_of(i) != region_of(j)) {
      mark_border(i);
      mark_border(j);
    }
    if (window_.record[j].progress.has(DiskProgress::at_border)) mark_lists_border(i);
    if (window_.record[i].progress.has(DiskProgress::at_border)) mark_lists_border(j);
  });
}

// The mark counts from the next slice on: in this one a disk that was active stays active.
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
