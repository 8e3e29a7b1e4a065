// Measurements in a shear flow: velocities relative to it, and the stress.
#pragma once

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// The disks with velocities relative to the flow rate (y - height / 2) along x. Unchanged if the box is not sheared.
Disks relative_to_flow(Disks disks, const Domain& box);

// The stress sigma_xy = -P_xy, which is viscosity times shear rate: with P_xy A = momentum_flow + shear_virial /
// elapsed. momentum_flow: sum of m ux uy of velocities u relative to the flow; energy. shear_virial: as in Counters,
// gathered in the time elapsed. Energy / area; 0 if elapsed is 0.
double shear_stress(double momentum_flow, double shear_virial, double elapsed, const Domain& box);

}  // namespace carom
