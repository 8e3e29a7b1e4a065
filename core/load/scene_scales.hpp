// The scales of a scene's physics, estimated before any step: how fast disks are, how often they collide.
#pragma once

#include "core/scene/scene.hpp"

namespace carom {

// The fastest of N disks over the root mean square of one component: sqrt(2 ln N), for N up to 10^6.
inline constexpr double fastest_share = 5.3;

// Estimated from the scene alone, so the same for every run and machine. The choice of a method is based on them.
struct SceneScales {
  double disks = 0.0;            // including all that sources may emit
  double diameter = 0.0;         // of the root mean square radius
  double smallest_radius = 0.0;  // length
  double packing_fraction = 0.0;
  // Root mean square of one velocity component; includes the speed gained by falling, given by moving walls to disks at
  // rest, and transferred from the spins of rough disks.
  double speed = 0.0;
  double fastest = 0.0;         // speed that hardly any disk exceeds, even light ones and those that start fast
  double vibration = 0.0;       // largest angular frequency of a vibrating wall; 1 / time
  double collision_rate = 0.0;  // of a disk, per unit time: 4 (Z - 1) speed / (sqrt(pi) diameter)
  // Collisions of a disk with sides, inner walls and fixed disks per unit time: speed / sqrt(2 pi) times their length
  // as the disk's centre meets it, over the area left to centres.
  double wall_rate = 0.0;
  double restitution = 1.0;   // the least of two disks of any groups, at the speed at which a law dissipates most
  double stopping = 0.0;      // in scenes that settle: energy lost by a stopped disk over that lost in a collision
  bool settles = false;       // gravity presses disks together and contacts dissipate: a pile forms
  bool driven = false;        // by moving walls: the speeds that disks reach are known only from a run
  bool may_collapse = false;  // infinitely many collisions in finite time are to be expected
};

// Compressibility P A / (N kT) of equal hard disks at a packing fraction below 1, good to 0.1 % up to 0.65 (virial
// series resummed; docs/reference_values.md).
double compressibility(double packing_fraction);

// Precondition: box and radii of the scene are known and good.
SceneScales scales_of(const Scene& scene);

}  // namespace carom
