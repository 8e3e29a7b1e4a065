// One step of growth: every disk takes its share of the gaps around it. The formulas are only here; the plain step is
// declared below, the parallel one in parallel/start/growth_step.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/exact_sum.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/physics/obstacle_contact.hpp"

namespace carom {

// The share of a gap that is closed in one step. With a larger share growth is faster, but leaves disks that nearly
// touch many others at the same time, whose collisions then come in bursts; closing all of it would leave nothing for
// rounding.
inline constexpr double closed_share = 0.75;

// The reach of a disk's search for others: disks further apart than the sum of their reaches do not limit each other.
inline double growth_reach(double radius, double target) {
  return radius + (target - radius) / closed_share;
}

// The part of the gap between two edges that growth may use; 0 if the gap is within the rounding of coordinates, so
// that no radius ever closes a gap by its last bit. length: the longer side of the box.
inline double usable_gap(double gap, double length) {
  return gap > 0x1p-46 * length ? closed_share * gap : 0.0;
}

// The radius that the gap to another disk allows: each of the two takes a share in proportion to what it lacks, so that
// together they never take more than the usable gap. Precondition: lack > 0.
inline double radius_within(double radius, double lack, double other_lack, double usable) {
  return radius + usable * (lack / (lack + other_lack));
}

// The radius that the sides allow; periodic ones allow any.
inline double radius_within_sides(const Domain& box, double x, double y, double radius) {
  double room = HUGE_VAL;
  if (!box.periodic_x()) room = std::min(x, box.width - x);
  if (!box.periodic_y()) room = std::min(room, std::min(y, box.height - y));
  if (room == HUGE_VAL) return room;
  return radius + usable_gap(room - radius, std::max(box.width, box.height));
}

// Is the disk within walls and sinks, to the last bit?
inline bool within_sides(const Domain& box, double x, double y, double radius) {
  return (box.periodic_x() || (x >= radius && x <= box.width - radius)) &&
         (box.periodic_y() || (y >= radius && y <= box.height - radius));
}

// The radius that the obstacles within reach allow, and whether the disk already overlaps one; obstacles take no part
// of a gap. reach: growth_reach.
struct RoomAtObstacles {
  double radius = HUGE_VAL;
  bool overlap = false;
};
inline RoomAtObstacles radius_within_obstacles(const Domain& box, double x, double y, double radius, double reach) {
  RoomAtObstacles room;
  if (box.obstacles == nullptr) return room;
  const double length = std::max(box.width, box.height);
  for_each_obstacle_touched(box, x, y, reach, [&](std::uint32_t k, const ObstacleGap&) {
    const double beyond = gap_to((*box.obstacles)[k], x, y, radius, box).beyond;
    room.overlap = room.overlap || beyond > 0.0;
    room.radius = std::min(room.radius, radius + usable_gap(-beyond, length));
  });
  return room;
}

// The results of a step. Sums have no rounding, so the order of the disks does not matter.
struct GrowthTally {
  std::size_t lacking = 0;  // disks that lacked something before the step
  bool overlap = false;     // did two disks, or a disk and a side or an obstacle, overlap before the step, by rounding?
  double most_lack = 0.0;   // largest target - radius of any disk after the step; length
  ExactSum area;            // of radius^2 after the step; length^2
  ExactSum lack;            // of target^2 - radius^2 after the step; length^2

  void add(double before, double after, double target) {
    lacking += before < target ? 1 : 0;
    most_lack = std::max(most_lack, target - after);
    area.add(after * after);
    lack.add(target * target - after * after);
  }
  void add(const GrowthTally& other) {
    lacking += other.lacking;
    overlap = overlap || other.overlap;
    most_lack = std::max(most_lack, other.most_lack);
    area.add(other.area);
    lack.add(other.lack);
  }
};

// Gives every disk the radius that all gaps around it allow, at most its target. Disks may be stored in any order, and
// keep it. Preconditions: disks has a radius column; target[id] is the final radius of disk id, nowhere below the
// present one; the box is at least two final diameters wide along a period.
GrowthTally grow_step(Disks& disks, const Domain& box, const std::vector<double>& target);

}  // namespace carom
