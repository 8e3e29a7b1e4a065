// The disks within the last window, from the workers' logs: their positions at a given time, their collisions, and the
// largest speed.
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

// Sets the position and velocity of disk i to those at the path's start.
inline void put(const PathSegment& p, Disks& d, std::size_t i) {
  d.x[i] = p.x;
  d.y[i] = p.y;
  d.vx[i] = p.vx;
  d.vy[i] = p.vy;
}

// Carries the disks, stored in the window's order, along their logged paths to time s of the window, and removes those
// that had left through a sink by then and those marked in left_out, which has an entry for each disk or is empty.
void move_along_paths(const WindowState& window, const SliceScheduler& scheduler, double s, const Domain& box,
                      const std::vector<unsigned char>& left_out, Disks& disks);

// The collisions of two disks in the window, which began at time `start`. id: of the disks in the window's order.
// counts: is a collision included whose disk with the smaller id is this one?
std::vector<DiskContact> contacts_of_window(const SliceScheduler& scheduler, const std::vector<DiskId>& id,
                                            double start, const std::function<bool(std::uint32_t)>& counts);

// The largest speed at the start of a path in the window, of those disks that count and have had an event; 0 if there
// is none.
double fastest_of_window(const SliceScheduler& scheduler, const std::function<bool(std::uint32_t)>& counts);

}  // namespace carom
