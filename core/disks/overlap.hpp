// The overlap of two disks, or of a disk and a wall.
#pragma once

#include <tuple>

#include "core/base/types.hpp"

namespace carom {

struct Overlap {
  double size = 0.0;        // over the sum of the radii; with a wall, over the radius
  DiskId id1 = 0, id2 = 0;  // id1 < id2; id2 may be a wall (contact_event.hpp)

  // Becomes the deeper of the two; of equal overlaps the one of smaller ids, so that their order does not matter.
  void raise_to(const Overlap& other) {
    const bool smaller = std::tie(other.id1, other.id2) < std::tie(id1, id2);
    if (other.size > size || (other.size == size && size > 0.0 && smaller)) *this = other;
  }
};

}  // namespace carom
