// One step of growth: every disk takes its share of the gaps around it. The formulas stand here once; the plain step is
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

// Share of a gap that is closed in one step. More of it grows faster, but leaves disks that nearly touch many others at
// once, whose collisions then come in bursts; all of it would leave nothing for rounding.
inline constexpr double closed_share = 0.75;

// How far a disk looks for others; what is further away than the sum of two such reaches stops neither.
inline double growth_reach(double radius, double target) {
  return radius + (target - radius) / closed_share;
}

// The room that growth may use between two edges; 0 where it is within the rounding of coordinates, so that no radius
// ever closes a gap by its last bit. length: the longer side of the box.
inline double usable_gap(double gap, double length) {
  return gap > 0x1p-46 * length ? closed_share * gap : 0.0;
}

// The radius that the gap to another disk allows: both get of it in proportion to what they lack, so that the two
// together never take more than the usable gap. Precondition: lack > 0.
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

// Does the disk lie within walls and sinks, to the last bit?
inline bool within_sides(const Domain& box, double x, double y, double radius) {
  return (box.periodic_x() || (x >= radius && x <= box.width - radius)) &&
         (box.periodic_y() || (y >= radius && y <= box.height - radius));
}

// The radius that the obstacles within reach allow, and whether the disk overlaps one as it is; they take nothing of a
// gap. reach: growth_reach.
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

// What a step found and did. Sums have no rounding, so the order of the disks does not matter.
struct GrowthTally {
  std::size_t lacking = 0;  // disks that lacked something before the step
  bool overlap = false;     // two disks, or a disk and a side or an obstacle, overlapped before the step, by rounding
  double most_lack = 0.0;   // target - radius after the step, the largest of any disk; length
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

// Gives every disk the radius that all gaps around it allow, its target at most. Disks may be stored in any order, and
// stay in it. Preconditions: disks has a radius column; target[id] is the final radius of disk id, nowhere below the
// present one; the box is two final diameters wide where it is periodic.
GrowthTally grow_step(Disks& disks, const Domain& box, const std::vector<double>& target);

}  // namespace carom
