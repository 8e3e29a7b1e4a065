// The state of every disk in the exact engine during a window, and the numbers that all disks share.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/physics/exact_event.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/engine_mode.hpp"
#include "parallel/exact/event_calendar.hpp"
#include "parallel/exact/known_band.hpp"
#include "parallel/exact/part_ends.hpp"

namespace carom {

// The distance, in entries, between the ends of two calendars, so that they are in different cache lines: threads write
// to them.
inline constexpr std::size_t entries_apart = 8;

// A disk is predicted again within this many windows, however short they are, so that the rounding at their starts,
// which adds up, stays below WindowState::blur.
inline constexpr int most_windows_predicted = 128;

// Columns are by storage index.
struct WindowState {
  EngineMode mode = EngineMode::single_queue;
  std::size_t regions = 0;   // as in ListLayout
  bool looks_ahead = false;  // as in ListLayout
  ExactRules rules;
  const Disks* disks = nullptr;  // for masses
  std::vector<DiskRecord> record;
  // The time of the next event that is stored with each disk. A contact of two disks is stored with the one whose path
  // began last, or with both; contact with a side and relisting with the disk itself. Behind the entries of the disks
  // are the ends of the calendars' lists.
  std::vector<CalendarEntry> entry;
  std::vector<double> last_contact;         // with the TC model
  std::vector<std::uint32_t> thermal_hits;  // with thermal sides
  std::vector<Burst> burst;                 // if any contact dissipates
  // With regions only.
  std::vector<std::uint16_t> region_of_tile;

  double length = 0.0;      // of the window; time
  double meant = 0.0;       // length without what cut it short; time
  double horizon = 0.0;     // events are predicted up to this time, beyond the window
  double next_start = 0.0;  // just beyond the window
  double slack = 0.0;       // rounding of a coordinate, generously; length
  // If two disks (or a disk and a side) are closer than `close` and approach each other more slowly than `slow`, the
  // rounding at each window's start decides whether they touch, and whether they approach.
  double close = 0.0;  // length
  double slow = 0.0;   // length / time
  // Rounding at the starts of windows moves a path by less than this relative to another one, or to a side. It decides
  // whether two disks touch that pass each other so near to their contact distance, however fast they are.
  double blur = 0.0;  // length
  double largest_radius = 0.0;
  // `close` and `slow` for two disks of any radii, as limits of (distance^2 - contact_distance^2)^2 and of (dr.dv)^2.
  double close2() const { return 16.0 * largest_radius * largest_radius * (close * close); }
  double slow2() const { return 4.0 * largest_radius * largest_radius * (slow * slow); }
  // May rounding at the next windows' starts decide whether these two disks touch up to the horizon, `span` from now?
  // They touch if the square of the distance at which they pass each other, cross^2 / speed2, is less than at contact.
  bool may_graze(const Relative& r, double contact_distance, double span) const {
    const double cross = r.dx * r.dvy - r.dy * r.dvx;
    const double speed2 = r.speed2();
    const double discriminant = speed2 * (contact_distance * contact_distance) - cross * cross;
    if (std::abs(discriminant) > speed2 * (contact_distance * blur) + slow2()) return false;
    const double reach = contact_distance + std::sqrt(speed2) * span + close;
    return r.distance2() <= reach * reach;
  }
  // The same for a disk and a side that it approaches against an acceleration: they touch if 2 gap * deceleration is
  // less than speed^2.
  bool may_graze_side(double gap, double speed, double acceleration, double span) const {
    if (!(acceleration < 0.0) || !(speed > 0.0) || speed > -acceleration * span) return false;
    const double discriminant = speed * speed + 2.0 * acceleration * gap;
    return std::abs(discriminant) <= -2.0 * acceleration * blur + slow * slow;
  }
  // As long as no disk has a larger v^2, none moves so far in a window that images beyond the nearest one, or crossing
  // events, matter.
  double safe_speed2 = 0.0;
  double fastest2 = 0.0;  // largest v^2 so far
  // With regions: if a segment begins with a larger v^2 than speed_limit2, the window is void. So no disk is faster
  // than speed_bound, gravity included.
  double speed_limit2 = 0.0;
  double speed_bound = 0.0;
  double slice_start = 0.0;
  double slice_end = 0.0;          // events before this time; in the last slice up to and including `length`
  KnownBand band;                  // no disk outside those held comes into it in the window
  bool is_part = false;            // is this a part of the box, with a halo?
  PartEnds part;                   // of a part: its ends
  std::vector<OtherParts> others;  // of a part: the other parts that each own disk concerns
  bool part_is_known = true;       // does each own disk that may come beyond an end have a ghost in the part there?
  // The largest NeighbourLists::depth_beyond_border of a disk listed in this window, a length; 0: none. Threads may set
  // it in any order, since it is a maximum; no bit depends on it, since a list that looks for images unnecessarily
  // finds the same contacts.
  std::atomic<double> depth_beyond_borders = 0.0;
  bool keeps_paths = true;
  Count most_paths = 0;         // of all disks; with more, the window is crowded (core/step/window_length.hpp)
  std::function<bool()> go_on;  // as in Engine::set_watch
  std::vector<double> spin;     // of rough disks, by storage index

  double next_event_time(std::uint32_t i) const { return entry[i].time; }
  void set_next_event_time(std::uint32_t i, double time) { entry[i].time = time; }
  // The entries of the disks [first, last), for number `calendar` of the calendars in use at the same time.
  CalendarEntries entries_of(std::uint32_t first, std::uint32_t last, std::size_t calendar) {
    const std::size_t end = record.size() + (calendar + 1) * entries_apart - 1;
    return {entry.data(), first, last, static_cast<std::uint32_t>(end)};
  }
  // Between windows: append_disk adds a disk, the last one; remove_disk removes disk i, and the last one takes its
  // index.
  void append_disk(double next_event);
  void remove_disk(std::size_t i);

  // The time at which a disk without an event up to the horizon is predicted again: within one window's time before the
  // horizon, and different for each disk, so that not all are predicted at once.
  double last_look(std::uint32_t i) const {
    constexpr std::uint32_t golden = 2654435769U;  // 2^32 over the golden ratio: its multiples are spread evenly
    return horizon - meant * (0x1p-32 * static_cast<double>(i * golden));
  }
  // May disk i, listed at height y with this skin, meet a disk that this rank does not have?
  bool is_beyond_band(std::uint32_t i, double y, double skin) const {
    return !band.holds(y, (skin + record[i].radius + largest_radius + slack) * (1.0 + 1e-9));
  }
  bool in_slice(double t) const { return t < slice_end && t <= length; }
  double slice_stop() const { return slice_end < length ? slice_end : length; }

  // Sets the numbers of a window, and gives columns room for all disks. fastest_speed2 (v^2) and radius: the largest of
  // any disk.
  void begin(const ExactRules& window_rules, const Disks& all, const WindowPlan& plan, double fastest_speed2,
             double radius);
  void release_memory();

 private:
  void set_tolerances(double start);
  double fastest_boundary() const;
};

}  // namespace carom
