#include "parallel/exact/safe_times.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

// A disk whose safe time proves to be later than it was queued for, by at least this share of the slice, is queued
// again; otherwise it is blocked.
constexpr double worthwhile_share = 1.0 / 16.0;
}  // namespace

std::uint32_t SafeTimes::blocking_tile(std::uint32_t i) const {
  const DiskProgress progress = window_.progress[i];
  if (progress.is(Progress::blocked)) return worker_.blocked[progress.record()].tile;
  return (window_.mark[i] & lists_other_region) != 0 ? serial_pass : lists_.tile_of(i);
}

double SafeTimes::known_until(std::uint32_t unresolved) const {
  const DiskProgress progress = window_.progress[unresolved];
  return progress.is(Progress::blocked) ? worker_.blocked[progress.record()].safe_time : window_.slice_start;
}

// Before this time, no earlier than `time`, the unresolved disk cannot touch disk i on its present path; `never` if not
// within the slice.
double SafeTimes::safe_time_from(std::uint32_t i, double time, std::uint32_t unresolved) const {
  const DiskRecord& f = window_.record[i];
  const DiskRecord& u = window_.record[unresolved];
  const double g = window_.rules.gravity;
  const double until = known_until(unresolved);
  const double from = std::max(time, until);
  const PathSegment p = carried_to(f.path, from, g);
  const PathSegment q = carried_to(u.path, until, g);
  const Relative r = relative(p, q, window_.rules.box);
  // Both towards each other, since the motion of the unresolved one is unknown.
  const double speed =
      std::sqrt(f.path.vx * f.path.vx + f.path.vy * f.path.vy) + g * window_.length + window_.speed_bound;
  const double contact_distance = f.radius + u.radius + window_.slack + window_.speed_bound * (from - until);
  const double most = contact_distance + speed * (window_.slice_stop() - from);
  const double distance2 = r.distance2();
  if (distance2 > most * most * (1.0 + 1e-9)) return never;
  return from + std::max(std::sqrt(distance2) - contact_distance, 0.0) / speed;
}

SafeTimes::SafeTime SafeTimes::safe_time(std::uint32_t i, double time) const {
  SafeTime first;
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (window_.progress[j].is_resolved()) return;
    first.any = true;
    const double t = safe_time_from(i, time, j);
    if (t < first.time) {
      first.time = t;
      first.tile = blocking_tile(j);
    }
  });
  return first;
}

void SafeTimes::push(std::uint32_t i, double time) {
  const SafeTime safe = safe_time(i, time);
  if (!safe.any) return;
  window_.mark[i] |= has_unresolved_neighbour;
  if (window_.in_slice(safe.time)) worker_.queue.push({safe.time, 0, 0, i | safe_time_bit});
}

void SafeTimes::reach(std::uint32_t i, double time) {
  const SafeTime safe = safe_time(i, time);
  const double slice = window_.slice_stop() - window_.slice_start;
  if (safe.time <= time + worthwhile_share * slice) {
    block(i, time, safe.tile);
  } else if (window_.in_slice(safe.time)) {
    worker_.queue.push({safe.time, 0, 0, i | safe_time_bit});
  }
}

void SafeTimes::block(std::uint32_t i, double time, std::uint32_t tile) {
  window_.progress[i] = DiskProgress::blocked(static_cast<std::uint32_t>(worker_.blocked.size()));
  worker_.blocked.push_back({i, tile, time});
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (window_.progress[j].is(Progress::done)) return;
    window_.mark[j] |= has_unresolved_neighbour;
    if (!window_.progress[j].is(Progress::active)) return;
    const double safe = safe_time_from(j, time, i);
    if (window_.in_slice(safe)) worker_.queue.push({safe, 0, 0, j | safe_time_bit});
  });
}

void SafeTimes::mark_relisted(std::uint32_t i) {
  const auto mark_later_tile = [&](std::uint32_t a, std::uint32_t b) {
    if (lists_.tile_of(b) > lists_.tile_of(a) || (window_.mark[b] & lists_other_region) != 0) {
      window_.mark[a] |= lists_later_tile;
    }
  };
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (region_of(i) != region_of(j)) {
      mark_other_region(i);
      mark_other_region(j);
    }
    mark_later_tile(i, j);
    mark_later_tile(j, i);
  });
}

void SafeTimes::mark_other_region(std::uint32_t i) {
  if ((window_.mark[i] & lists_other_region) != 0) return;
  window_.mark[i] |= lists_other_region;
  worker_.border.push_back(i);
  lists_.for_each_neighbour(i, [&](std::uint32_t j) { window_.mark[j] |= lists_later_tile; });
}

}  // namespace carom
