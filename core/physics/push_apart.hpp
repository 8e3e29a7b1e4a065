// Removal of the overlap that is left after the collisions of a step: disks are pushed apart and out of walls;
// velocities do not change. The reference calls this on the whole sorted list, the engine on independent parts of it.
// Fault F11: docs/original.md.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/physics/resolve.hpp"

namespace carom {

// Puts a disk that reaches further than slack (length) beyond a wall back to slack beyond it.
template <class View>
void push_wall(const View& d, const Domain& box, std::uint32_t i, Side side, double slack) {
  const double r = d.radius(i);
  const double push = reach_beyond_wall(side, d.x[i], d.y[i], r, box) - slack;
  if (!(push > 0.0)) return;
  if (side == Side::left || side == Side::right) {
    d.x[i] = touching_coordinate(side, r, box) + (side == Side::left ? -slack : slack);
  } else {
    d.y[i] = touching_coordinate(side, r, box) + (side == Side::bottom ? -slack : slack);
  }
}

// The same for an obstacle.
template <class View>
void push_from_obstacle(const View& d, const Domain& box, std::uint32_t i, const Obstacle& o, double slack) {
  const ObstacleGap gap = gap_to(o, d.x[i], d.y[i], d.radius(i), box);
  const double push = gap.beyond - slack;
  if (!(push > 0.0)) return;
  d.x[i] += push * gap.nx;
  d.y[i] += push * gap.ny;
}

// The first sweep pushes every contact. Further sweeps push only contacts that overlap by more than this share of the
// sum of radii (well below the 2 % that a pile may overlap), until there are none or after most_push_sweeps; what is
// left waits for the next step.
inline constexpr double shallow_overlap = 1e-3;
inline constexpr int most_push_sweeps = 4;
// The same limit in a pile, where whole layers have to make room.
inline constexpr int most_pile_push_sweeps = 256;
// A light disk between heavy ones moves them in each sweep only by its share of the mass, so after shallow_push_sweeps
// only overlaps above deep_overlap are pushed on. For loaded contacts that holds from the second sweep on: pushing the
// contacts of a pile for less opens some of them in every step, and each lost load starts a tremor.
inline constexpr int shallow_push_sweeps = 32;
inline constexpr double deep_overlap = 5e-3;
inline double overlap_to_push(int sweep, bool loaded) {
  return sweep < shallow_push_sweeps && !loaded ? shallow_overlap : deep_overlap;
}
inline int push_sweeps(const StepRules& rules) {
  return rules.settles ? most_pile_push_sweeps : most_push_sweeps;
}

// keep_inside leaves a disk in a wall by exactly shallow_overlap of its radius, so rounding would decide whether that
// is deep. With this margin it counts as deep, at all sides of the box alike.
inline constexpr double rounding_of_depth = 1e-6;

// Is the overlap of a contact deeper than slack (length) by more than `share` of the sum of radii (of the radius, at a
// wall)?
template <class View>
bool is_deep(const View& d, const Domain& box, const ContactEvent& e, double share, double slack = 0.0) {
  const double r = d.radius(e.i1);
  if (is_wall(e.id2)) {
    return reach_beyond_wall(d, box, e.i1, e.id2) > share * (1.0 - rounding_of_depth) * r + slack;
  }
  const double reach = (r + d.radius(e.i2)) * (1.0 - share) - slack;
  return distance2_of(d, e.i1, e.i2, box) < reach * reach;
}

// Walls do not give way: a disk that was pushed into a wall deeper than shallow_overlap of its radius is put back. If
// that makes it overlap others, the next sweep pushes those.
template <class View>
void keep_inside(const View& d, const Domain& box, std::uint32_t i) {
  for (Side side : all_sides) {
    if (box.side(side) == SideKind::wall) push_wall(d, box, i, side, shallow_overlap * d.radius(i));
  }
  if (box.obstacles == nullptr) return;
  for_each_solid_touched_in_order(box, d.x[i], d.y[i], d.radius(i), [&](std::uint32_t k, const ObstacleGap&) {
    push_from_obstacle(d, box, i, (*box.obstacles)[k], shallow_overlap * d.radius(i));
  });
}

// Pushes two disks apart until they overlap by no more than slack (length): along the line of centres, in inverse
// proportion to their masses, so that their centre of mass and with it the potential energy stays. Coincident centres
// part along x. Neither disk is left in a wall.
template <class View>
void push_pair(const View& d, const Domain& box, std::uint32_t i, std::uint32_t j, double slack) {
  const Relative r = relative(d, i, j, box);
  const double contact_distance = d.radius(i) + d.radius(j);
  const double distance2 = r.distance2();
  if (distance2 >= contact_distance * contact_distance) return;
  const double distance = std::sqrt(distance2);
  const double push = contact_distance - distance - slack;
  if (!(push > 0.0)) return;
  const Shares share = shares_of(d, i, j);
  const double px = distance > 0.0 ? push * (r.dx / distance) : push;
  const double py = distance > 0.0 ? push * (r.dy / distance) : 0.0;
  d.x[i] -= share.first * px;
  d.y[i] -= share.first * py;
  d.x[j] += share.second * px;
  d.y[j] += share.second * py;
  keep_inside(d, box, i);
  keep_inside(d, box, j);
}

template <class View>
void push_apart(const View& d, const Domain& box, const ContactEvent& e, double slack) {
  if (is_obstacle(e.id2)) {
    push_from_obstacle(d, box, e.i1, (*box.obstacles)[obstacle_of(e.id2)], slack);
  } else if (is_wall(e.id2)) {
    push_wall(d, box, e.i1, wall_side(e.id2), slack);
  } else {
    push_pair(d, box, e.i1, e.i2, slack);
  }
}

}  // namespace carom
