// When the contacts of a settling step are searched for and resolved again. A disk that is knocked on or pushed aside
// may run into a third disk that had no contact when the step's contacts were found. In a pile that third disk cannot
// give way, and if it had to wait for the next step it would be squeezed.
#pragma once

#include "core/disks/disk_view.hpp"
#include "core/disks/domain.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/resolve.hpp"

namespace carom {

// The most rounds of searching and resolving in a step, the first included. The front of an impact on a loose layer
// moves on by one disk in a round. Few steps take more than two rounds; 10^4 disks of radii 1 : 10 that landed at the
// longest safe step overlapped by up to 3.0 % with 8 rounds, and by 1.5 % with 32.
inline constexpr int most_rounds = 32;

// A disk that a round moved by less than this share of its radius needs no other round.
inline constexpr double displaced_share = 0.005;

// Overlap, over the sum of radii (at a wall, over the radius), above which a disk is pressed and another round follows:
// half of what a pile may have.
inline constexpr double pressed_overlap = 0.01;

// Squared displacement of disk i from (x0, y0), its place in the round's search; length^2.
template <class View>
double displacement2(const View& d, const Domain& box, std::size_t i, double x0, double y0) {
  return nearest_distance2({d.x[i] - x0, d.y[i] - y0}, box);
}

// Was disk i moved far enough to meet others?
template <class View>
bool is_displaced(const View& d, const Domain& box, std::size_t i, double x0, double y0) {
  const double far = displaced_share * d.radius(i);
  return displacement2(d, box, i, x0, y0) > far * far;
}

// Is disk i pressed into a wall or an obstacle?
template <class View>
bool is_pressed_into_wall(const View& d, const Domain& box, std::size_t i) {
  const double r = d.radius(i);
  for (Side side : all_sides) {
    if (box.side(side) == SideKind::wall && reach_beyond_wall(side, d.x[i], d.y[i], r, box) > pressed_overlap * r)
      return true;
  }
  bool pressed = false;
  if (box.obstacles == nullptr) return pressed;
  for_each_solid_touched(box, d.x[i], d.y[i], r, [&](std::uint32_t, const ObstacleGap& gap) {
    pressed = pressed || gap.beyond > pressed_overlap * r;
  });
  return pressed;
}

// Are disks i and j pressed into each other?
template <class View>
bool are_pressed(const View& d, const Domain& box, std::size_t i, std::size_t j) {
  const double reach = (d.radius(i) + d.radius(j)) * (1.0 - pressed_overlap);
  return nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box) < reach * reach;
}

}  // namespace carom
