// With regions: the time up to which the path of a disk is right while the motion of others is not known.
#pragma once

#include <cstdint>

#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"

namespace carom {

// No disk is faster than window.speed_bound. So a disk whose motion is not known yet cannot touch disk i before disk
// i's safe time: gap / (speed_bound + own speed) after the moment up to which that motion is known. Disk i is blocked
// at its safe time; up to then its path is right, whatever the other disk does.
class SafeTimes {
 public:
  SafeTimes(WindowState& window, NeighbourLists& lists, Worker& worker)
      : window_(window), lists_(lists), worker_(worker) {}

  // The time at which the first safe time is due; `never` if there is none.
  double first() const { return worker_.safe_times.empty() ? never : worker_.safe_times.front().time; }
  // Computes the safe time of a disk whose motion is known up to `time`, and keeps it if it is within the slice.
  void push(std::uint32_t i, double time);
  // Takes the first safe time that is due and computes it again, since it may have become later. Returns whether the
  // disk must be blocked now.
  bool reach_first(SafeTimeDue& due);
  // Disk i's motion is not known from now on: its active neighbours get safe times, too.
  void block(std::uint32_t i, double time);

  // Disk i of a region, which is not at its border, has a new list: computes its safe time as push() does.
  void mark_relisted(std::uint32_t i, double time);
  // Disk i, of any place, has a new list, and other disks list it than before: sets the resulting marks.
  void mark_relisted_at_border(std::uint32_t i);

 private:
  struct SafeTime {
    double time = never;
    bool any = false;  // is there a neighbour whose motion is not known?
  };
  // The place of a disk at a time.
  struct Place {
    double time;
    double x, y;
    double radius;
  };

  Place place_at(std::uint32_t i, double time) const;
  double distance2(const Place& a, const Place& b, bool inside) const;
  double closing_speed(std::uint32_t i) const;
  SafeTime safe_time(std::uint32_t i, double time) const;
  void push_due(double time, std::uint32_t i);
  void mark_unresolved_neighbour(std::uint32_t i);
  void mark_border(std::uint32_t i);
  void mark_lists_border(std::uint32_t i);
  std::uint16_t region_of(std::uint32_t i) const { return window_.region_of_tile[lists_.tile_of(i)]; }

  WindowState& window_;
  NeighbourLists& lists_;
  Worker& worker_;
};

}  // namespace carom
