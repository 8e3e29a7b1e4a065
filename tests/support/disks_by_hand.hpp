// Makes scenes, boxes and disks in a test, without a scene file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/draws.hpp"

namespace carom::test {

// A box of elastic walls without gravity.
inline Scene scene_of(Method method, double width, double height, double dt, double t_end) {
  Scene scene;
  scene.title = "test";
  scene.box.width = width;
  scene.box.height = height;
  scene.run = {method, dt, t_end};
  return scene;
}

inline void set_sides(Domain& box, SideKind left_right, SideKind bottom_top) {
  box.sides = {left_right, left_right, bottom_top, bottom_top};
}

// The axes along which a box is periodic; its other sides are walls.
enum class Periodic : std::uint8_t { none, x, y, both };

constexpr Periodic periodic_along(bool x, bool y) {
  return x && y ? Periodic::both : x ? Periodic::x : y ? Periodic::y : Periodic::none;
}

inline Domain box_of(double width, double height, Periodic along = Periodic::none) {
  const bool x = along == Periodic::x || along == Periodic::both, y = along == Periodic::y || along == Periodic::both;
  Domain box{width, height};
  set_sides(box, x ? SideKind::periodic : SideKind::wall, y ? SideKind::periodic : SideKind::wall);
  return box;
}

inline Disks disks_of(const std::vector<Disk>& list) {
  Disks disks;
  for (std::size_t i = 0; i < list.size(); ++i) {
    Disk disk = list[i];
    disk.id = static_cast<DiskId>(i);
    append(disks, disk);
  }
  return disks;
}

// Disks of radius 0.1 and mass 1 at rest, with centres anywhere in the box: they may overlap.
inline Disks strewn(Draws& draws, const Domain& box, std::size_t n) {
  Disks disks;
  for (std::size_t i = 0; i < n; ++i) {
    append(disks, {draws.in(0.0, box.width), draws.in(0.0, box.height), 0.0, 0.0, 0.1, 1.0, static_cast<DiskId>(i)});
  }
  return disks;
}

// Ids from 0 on, in the order of the list.
inline State state_of(const std::vector<Disk>& list) {
  State state;
  state.disks = disks_of(list);
  state.next_id = static_cast<DiskId>(list.size());
  return state;
}

inline State state_of(const Scene& scene, const std::vector<Disk>& list) {
  State state = state_of(list);
  state.sources.resize(scene.sources.size());
  return state;
}

// Centre of cell k of a square of per_side x per_side cells, row by row.
inline Vec2 cell_centre(int k, int per_side, double cell) {
  const int column = k % per_side;
  const int row = k / per_side;
  return {cell * (0.5 + column), cell * (0.5 + row)};
}

struct Ranges {
  double radius_low = 1.0, radius_high = 1.0;
  double mass_low = 1.0, mass_high = 1.0;
  double speed = 1.0;  // each component in [-speed, speed]
};

// n disks without overlap, at a modest density: at a high one there may be no room for large disks.
inline std::vector<Disk> random_disks(Draws& draws, const Domain& box, std::size_t n, const Ranges& ranges) {
  std::vector<Disk> list;
  while (list.size() < n) {
    Disk d;
    d.radius = draws.in(ranges.radius_low, ranges.radius_high);
    d.mass = draws.in(ranges.mass_low, ranges.mass_high);
    d.x = draws.in(d.radius, box.width - d.radius);
    d.y = draws.in(d.radius, box.height - d.radius);
    d.vx = draws.in(-ranges.speed, ranges.speed);
    d.vy = draws.in(-ranges.speed, ranges.speed);
    bool free = true;
    for (const Disk& other : list) {
      const double dx = d.x - other.x;
      const double dy = d.y - other.y;
      free = free && !touches(dx * dx + dy * dy, d.radius + other.radius);
    }
    if (free) list.push_back(d);
  }
  return list;
}

}  // namespace carom::test
