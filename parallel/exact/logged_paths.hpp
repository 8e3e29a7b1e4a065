// What the workers' logs say of the last window: where disks were at a time within it, and which of them collided,
// and how fast they were.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/disks/disk_contact.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/exact/slice_scheduler.hpp"
#include "parallel/exact/window_state.hpp"

namespace carom {

// Makes the position and velocity of disk i those of the path's start.
inline void put(const PathSegment& p, Disks& d, std::size_t i) {
  d.x[i] = p.x;
  d.y[i] = p.y;
  d.vx[i] = p.vx;
  d.vy[i] = p.vy;
}

// Carries the disks, stored as the window has them, along their logged paths to time s of the window; those that had
// left through a sink by then are removed, and those marked in left_out, which has an entry for each or is empty.
void move_along_paths(const WindowState& window, const SliceScheduler& scheduler, double s, const Domain& box,
                      const std::vector<unsigned char>& left_out, Disks& disks);

// The collisions of two disks in the window, which began at time `start`. id: of the disks as the window has them.
// counts: is a collision of which this disk has the smaller id one of them?
std::vector<DiskContact> contacts_of_window(const SliceScheduler& scheduler, const std::vector<DiskId>& id,
                                            double start, const std::function<bool(std::uint32_t)>& counts);

// The largest speed with which a path of the window begins, of those disks that count and have met anything; else 0.
double fastest_of_window(const SliceScheduler& scheduler, const std::function<bool(std::uint32_t)>& counts);

}  // namespace carom
