// A disk that crosses the bottom or the top of a sheared box comes back with the velocity of its image.
#pragma once

#include <cstddef>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/physics/impact_tally.hpp"

namespace carom {

// Brings disk i back into the box after a move. box: at the time of the disks.
inline void cross_sheared(Disks& d, std::size_t i, const Domain& box, ImpactTally& tally) {
  const double rows = wrap_sheared(d.x[i], d.y[i], box.shear.offset, box);
  if (rows != 0.0) tally.add_shear(0.0, box.shear.jump_rows(d.mass_of(i), d.vx[i], rows));
}

}  // namespace carom
