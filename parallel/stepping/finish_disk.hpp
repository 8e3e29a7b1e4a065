// The end of a step for a disk that had contacts in it.
#pragma once

#include <cstddef>

#include "core/disks/domain.hpp"
#include "core/physics/advance.hpp"
#include "core/reference/step_contacts.hpp"
#include "core/step/validity.hpp"
#include "parallel/stepping/wall_reach.hpp"

namespace carom {

// Not inlined: few disks reach beyond a wall, and the loop over all contacts keeps its registers.
template <class View>
[[gnu::noinline]] void raise_to_wall_overlap_apart(const View& d, const Domain& box, std::uint32_t i,
                                                   StepFigures& seen) {
  raise_to_wall_overlap(d, box, i, seen);
}

// Columns: Disks, or a view of them.
template <class Columns>
double speed2_of(const Columns& d, std::size_t i) {
  return d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i];
}

// Wraps disk i after its contacts, in a box that is not sheared. Returns its squared speed.
template <class Columns>
double wrap_moved(Columns& d, const Domain& box, std::size_t i) {
  wrap(d.x[i], d.y[i], box);
  return speed2_of(d, i);
}

// The same, and enters the overlap of the disk with walls in `seen`. In a sheared box the caller wraps disks
// (move_sheared).
template <class View>
double finish_disk(const View& d, const Domain& box, const WallReach& walls, std::uint32_t i, StepFigures& seen) {
  if (walls.touches(d.x[i], d.y[i], d.radius(i))) raise_to_wall_overlap_apart(d, box, i, seen);
  if constexpr (View::is_sheared) {
    return speed2_of(d, i);
  } else {
    return wrap_moved(d, box, i);
  }
}

}  // namespace carom
