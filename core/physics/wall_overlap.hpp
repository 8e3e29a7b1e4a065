// How deep disks lie in walls and solid obstacles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/overlap.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/obstacle_contact.hpp"

namespace carom {

// Raises `deepest` to the overlap of a disk of radius r at (x, y) with walls and solid obstacles, over r. A disk that
// touches an inner sink is left out: it may lie in an opening of a wall.
inline void raise_to_wall_overlap(double x, double y, double r, DiskId id, const Domain& box, Overlap& deepest) {
  if (touches_inner_sink(box, x, y, r)) return;
  for (Side side : all_sides) {
    if (box.side(side) != SideKind::wall) continue;
    const double beyond = reach_beyond_wall(side, x, y, r, box);
    if (beyond > 0.0) deepest.raise_to({beyond / r, id, wall_partner(side)});
  }
  if (box.obstacles == nullptr || box.obstacles->clearance({x, y}) >= r) return;
  for_each_solid_touched(box, x, y, r, [&](std::uint32_t k, const ObstacleGap& gap) {
    if (gap.beyond > 0.0) deepest.raise_to({gap.beyond / r, id, obstacle_partner(k)});
  });
}

// The deepest wall overlap of disks [begin, end); size 0 if there is none.
inline Overlap deepest_wall_overlap(const Disks& d, const Domain& box, std::size_t begin, std::size_t end) {
  Overlap deepest;
  for (std::size_t i = begin; i < end; ++i)
    raise_to_wall_overlap(d.x[i], d.y[i], d.radius_of(i), d.id[i], box, deepest);
  return deepest;
}

}  // namespace carom
