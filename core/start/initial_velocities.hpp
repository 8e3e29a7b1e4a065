// Giving the disks of a scene their first velocities.
#pragma once

#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Sets vx and vy of all disks, entry i having id i, by the law of the group of each. maxwell: normal deviates with
// variance T / m a component, then the group's mean velocity (weighted by mass) is taken off and the rest scaled, so
// that the kinetic energy is count * T (two degrees of freedom a disk, k_B = 1) to rounding. Sums run in id order. The
// group's drift is added last.
// Precondition: radius and mass are known. Throws InputError for velocities that are not finite.
void set_velocities(const Scene& scene, Disks& disks);

// Where disks are rough: gives them their moments of inertia and first spins, likewise by the law of the group of each.
void set_spins(const Scene& scene, Disks& disks);

}  // namespace carom
