// The box [0, width] x [0, height]: its four sides, its obstacles, nearest images and wrapping.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/types.hpp"
#include "core/disks/shear.hpp"
#include "core/disks/side_motion.hpp"
#include "core/disks/wall_motion.hpp"

namespace carom {

class ObstacleCells;

enum class Side : std::uint8_t { left, right, bottom, top };
inline constexpr std::array<Side, 4> all_sides{Side::left, Side::right, Side::bottom, Side::top};

enum class SideKind : std::uint8_t { wall, periodic, sink };

struct Domain {
  double width = 0.0;   // length
  double height = 0.0;  // length
  std::array<SideKind, 4> sides{SideKind::wall, SideKind::wall, SideKind::wall, SideKind::wall};
  std::array<double, 4> restitutions{1.0, 1.0, 1.0, 1.0};  // in [0, 1]; only those of walls count
  std::array<double, 4> temperatures{0.0, 0.0, 0.0, 0.0};  // of thermal walls, energy; 0: not thermal
  std::array<SideMotion, 4> motions{};                     // of walls
  // Their places at the time that the box is used for; 0 for sides at rest.
  std::array<SidePlace, 4> places{};
  Shear shear{};  // of a box that is periodic both ways, at the time that the box is used for
  // Obstacles in the box (place_obstacles); null if there are none. They outlive the box.
  const ObstacleCells* obstacles = nullptr;
  bool inner_walls_move = false;  // at least one of them
  BoxTime clock{};                // their time

  SideKind side(Side s) const { return sides[static_cast<std::size_t>(s)]; }
  // Of a wall: speed away from it over speed towards it. (Walls of docs/original.md are always elastic.)
  double restitution(Side s) const { return restitutions[static_cast<std::size_t>(s)]; }
  // A thermal wall reflects with Maxwell's flux distribution (core/physics/thermal_side.hpp).
  double temperature(Side s) const { return temperatures[static_cast<std::size_t>(s)]; }
  bool is_thermal(Side s) const { return temperature(s) > 0.0; }
  bool has_thermal_side() const {
    return is_thermal(Side::left) || is_thermal(Side::right) || is_thermal(Side::bottom) || is_thermal(Side::top);
  }
  bool moves(Side s) const { return motions[static_cast<std::size_t>(s)].moves(); }
  bool has_moving_side() const {
    return moves(Side::left) || moves(Side::right) || moves(Side::bottom) || moves(Side::top);
  }
  // A side or an inner wall.
  bool has_moving_wall() const { return has_moving_side() || inner_walls_move; }
  const SidePlace& place(Side s) const { return places[static_cast<std::size_t>(s)]; }
  // Its place a time t >= 0 later.
  SidePlace place_after(Side s, double t) const {
    const SideMotion& motion = motions[static_cast<std::size_t>(s)];
    return motion.kind == SideMotion::Kind::sine ? motion.swung(place(s), t) : place(s).after(t);
  }
  // Sets moving walls to their places at time t.
  void move_walls(double t) {
    clock = {t, t};
    for (std::size_t s = 0; s < motions.size(); ++s) places[s] = motions[s].at(t);
  }
  // Sets them to their places at time `to`, with their mean speed since `from`, as time stepping needs it.
  void step_walls(double from, double to) {
    clock = {from, to};
    for (std::size_t s = 0; s < motions.size(); ++s) {
      if (!motions[s].moves()) continue;
      const double inset = motions[s].at(to).inset;
      places[s] = {inset, (inset - motions[s].at(from).inset) / (to - from), 0.0};
    }
  }
  // Sets the images above a sheared box to their places at time t.
  void move_images(double t) { shear.offset = shear.offset_at(t, width); }
  // May a collision with a wall lose energy?
  bool walls_dissipate() const {
    for (Side s : all_sides) {
      if (side(s) == SideKind::wall && restitution(s) < 1.0) return true;
    }
    return false;
  }
  bool periodic_x() const { return side(Side::left) == SideKind::periodic; }
  bool periodic_y() const { return side(Side::bottom) == SideKind::periodic; }
  bool has(SideKind kind) const {
    for (SideKind k : sides) {
      if (k == kind) return true;
    }
    return false;
  }
};

// The box with its moving walls and the images of a sheared box at their places at time t.
inline Domain box_at(Domain box, double t) {
  if (box.has_moving_wall()) box.move_walls(t);
  if (box.shear.acts()) box.move_images(t);
  return box;
}

// The box with its moving sides at the mean of their places from one time to a later one.
inline Domain box_in_mean(Domain box, double from, double to) {
  for (std::size_t s = 0; s < box.motions.size(); ++s) {
    if (box.motions[s].moves()) box.places[s] = {box.motions[s].mean_inset(from, to), 0.0, 0.0};
  }
  return box;
}

// One component of the difference between two positions, taken to the nearest image.
// Precondition: |d| < 1.5 period (both positions wrapped, or out by less than a quarter period).
// Antisymmetric in d, so the order of the two disks does not change the bits of a distance.
inline double nearest_image(double d, double period) {
  const double half = 0.5 * period;
  if (d > half) return d - period;
  if (d < -half) return d + period;
  return d;
}

// The row of the nearest image in a sheared box: boxes above the box itself, -1, 0 or 1. dy: as d in nearest_image.
inline int rows_to_nearest(double dy, const Domain& box) {
  const double half = 0.5 * box.height;
  return dy > half ? -1 : dy < -half ? 1 : 0;
}

// The difference of two positions in a sheared box, taken to the nearest image in the row `rows` boxes above (-1, 0 or
// 1). offset: displacement of the images above; length. Antisymmetric in d and rows together.
inline Vec2 image_in_row(Vec2 d, int rows, double offset, const Domain& box) {
  if (rows != 0) {
    d.y = rows > 0 ? d.y + box.height : d.y - box.height;
    // The offset may add half a period: one more than nearest_image can take.
    d.x = nearest_image(rows > 0 ? d.x + offset : d.x - offset, box.width);
  }
  d.x = nearest_image(d.x, box.width);
  return d;
}

// Not inlined: a sheared box is rare, and loops keep their registers.
[[gnu::noinline, gnu::cold]] inline Vec2 nearest_sheared_image(Vec2 d, const Domain& box) {
  return image_in_row(d, rows_to_nearest(d.y, box), box.shear.offset, box);
}

// The difference of two positions, taken to the nearest image across periodic sides of a box that is not sheared.
// Precondition as above.
[[gnu::always_inline]] inline Vec2 nearest_image_at_rest(Vec2 d, const Domain& box) {
  if (box.periodic_x()) d.x = nearest_image(d.x, box.width);
  if (box.periodic_y()) d.y = nearest_image(d.y, box.height);
  return d;
}

// The difference of two positions, taken to the nearest image across periodic sides. Precondition as above; in a
// sheared box distances are the least ones where they are below half the height.
[[gnu::always_inline]] inline Vec2 nearest_image(Vec2 d, const Domain& box) {
  if (box.shear.acts()) [[unlikely]]
    return nearest_sheared_image(d, box);
  return nearest_image_at_rest(d, box);
}

// Squared distance of two positions whose difference is d, nearest image; length^2. Precondition as above.
inline double nearest_distance2(Vec2 d, const Domain& box) {
  d = nearest_image(d, box);
  return d.x * d.x + d.y * d.y;
}

// wrap() of a disk that a far too long step has sent further than a period: exact at any distance. Not inline: a copy
// compiled with the kernels for a wider instruction set might otherwise be linked for every machine.
double wrap_far(double c, double period);

// A coordinate brought back into [0, period).
// A tiny negative c gives c + period == period in floating point; that is the same place as 0.
[[gnu::always_inline]] inline double wrap(double c, double period) {
  if (c < 0.0) {
    c += period;
    if (c < 0.0) return wrap_far(c, period);
    return c < period ? c : 0.0;
  }
  if (c < period) return c;
  c -= period;
  return c < period ? c : wrap_far(c, period);
}

// wrap_sheared() of a place that is several boxes away.
double wrap_sheared_far(double& x, double& y, double offset, const Domain& box);

// Brings a place back into a sheared box whose images above are displaced by offset. Returns by how many boxes it has
// been moved up: a whole number, -1, 0 or 1 unless a step is far too long. The velocity along x changes by that number
// times the shear's jump.
inline double wrap_sheared(double& x, double& y, double offset, const Domain& box) {
  double rows = 0.0;
  if (y < -box.height || y >= box.height + box.height) [[unlikely]] {
    rows = wrap_sheared_far(x, y, offset, box);
  } else if (y < 0.0 && y + box.height < box.height) {
    rows = 1.0;
    y += box.height;
    x += offset;
  } else if (y < 0.0) {
    y = 0.0;  // closer to the side than y can tell
  } else if (y >= box.height) {
    rows = -1.0;
    y -= box.height;
    x -= offset;
  }
  x = wrap(x, box.width);
  return rows;
}

}  // namespace carom
