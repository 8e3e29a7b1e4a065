#include "parallel/exact/window_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/huge_pages.hpp"

namespace carom {

namespace {

// Events are predicted ahead for this many windows of the length that they are meant to have; a disk without an event
// by then is predicted again.
constexpr double windows_ahead = 4.0;
// Among disks at rest a window may be meant to last for ever: it counts as at most this many times its real length.
constexpr double most_shortened = 0x1p20;
// Rounding shifts the time at which disks meet that approach faster than `slow` by less than 1 / rounding_ratio of the
// length that the window is meant to have.
constexpr double rounding_ratio = 1e5;
// Two paths have two coordinates each, which are rounded a few times in each of the windows for which they are
// predicted.
constexpr double blur_in_roundings = 16.0 * most_windows_predicted;

// Reserves room for a few more disks: with ghosts, their number varies a little. Pages that are never written take no
// memory.
template <class T>
void resize_column(std::vector<T>& column, std::size_t n) {
  if (column.capacity() < n) resize_in_huge_pages(column, n, T{}, n + n / 32);
  column.resize(n);
}

}  // namespace

void WindowState::begin(const ExactRules& window_rules, const Disks& all, const WindowPlan& plan, double fastest_speed2,
                        double radius) {
  rules = window_rules;
  disks = &all;
  length = plan.length;
  meant = std::min(plan.meant, most_shortened * plan.length);
  horizon = windows_ahead * meant;
  next_start = std::nextafter(plan.length, never);
  fastest2 = fastest_speed2;
  largest_radius = radius;
  depth_beyond_borders.store(0.0, std::memory_order_relaxed);
  set_tolerances(plan.start);
  resize_column(entry, all.size() + std::max<std::size_t>(regions, 1) * entries_apart);
  // The records are written anew, so the column is freed before it grows: there are never two copies of it, the
  // largest.
  if (record.capacity() < all.size()) std::vector<DiskRecord>().swap(record);
  resize_column(record, all.size());
  burst.resize(dissipates(rules) ? all.size() : 0);
  spin = all.spin;
}

// The largest speed of boundaries that move with the time of the run: sides, and the images above a sheared box.
double WindowState::fastest_boundary() const {
  double speed = std::abs(rules.box.shear.jump);
  for (const SideMotion& motion : rules.box.motions) speed = std::max(speed, motion.largest_speed());
  return speed;
}

// start: of the window, absolute time.
void WindowState::set_tolerances(double start) {
  const double side = std::max(rules.box.width, rules.box.height);
  slack = 1e-9 * 2.0 * largest_radius + 1e-14 * side;
  // The rounding of coordinates, of distances flown in the windows ahead, and of distances moved by sides and images up
  // to then.
  const double fastest = std::sqrt(fastest2) + rules.gravity.size * length;
  const double rounding = 0x1p-51 * (side + fastest * horizon + fastest_boundary() * (start + horizon));
  close = 4.0 * rounding_ratio * rounding;
  slow = rounding_ratio * rounding / meant;
  blur = blur_in_roundings * rounding;
}

void WindowState::append_disk(double next_event) {
  record.emplace_back();
  entry.emplace_back();
  entry[record.size() - 1].time = next_event;
}

void WindowState::remove_disk(std::size_t i) {
  entry[i] = entry[record.size() - 1];
  record[i] = record.back();
  record.pop_back();
}

void WindowState::release_memory() {
  std::vector<DiskRecord>().swap(record);
  std::vector<CalendarEntry>().swap(entry);
  std::vector<OtherParts>().swap(others);
}

}  // namespace carom
