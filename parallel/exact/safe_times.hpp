// With regions: how far a disk may go while the motion of others is not known.
#pragma once

#include <cstdint>

#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"

namespace carom {

// No disk is faster than window.speed_bound, so that a disk whose motion is not yet known cannot touch disk i before
// its safe time, gap / (speed_bound + own speed) after the moment up to which it is known. Disk i is blocked at its
// safe time; up to then its path is right, whatever happens elsewhere.
class SafeTimes {
 public:
  SafeTimes(WindowState& window, NeighbourLists& lists, Worker& worker)
      : window_(window), lists_(lists), worker_(worker) {}

  // When the first of them is due; `never` if there is none.
  double first() const { return worker_.safe_times.empty() ? never : worker_.safe_times.front().time; }
  // Asks for the safe time of the disk, whose motion is known up to `time`, when it comes, if it is within the slice.
  void push(std::uint32_t i, double time);
  // The first that is due has come; it may be later by now, if the disk's path has changed. Is the disk to be blocked?
  bool reach_first(SafeTimeDue& due);
  // Disk i's motion is not known from now on, so that its active neighbours get safe times too.
  void block(std::uint32_t i, double time);

  // Disk i, of a region and not at its border, has a new list; asks for its safe time as push() does.
  void mark_relisted(std::uint32_t i, double time);
  // Any disk i has a new list, and is in other disks' lists than before.
  void mark_relisted_at_border(std::uint32_t i);

 private:
  struct SafeTime {
    double time = never;
    bool any = false;  // is a neighbour's motion not known?
  };
  // One of a pair whose distance is asked for, at a time.
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
