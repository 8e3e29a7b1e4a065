// The scales of a scene's physics, estimated before any step: how fast disks are, how often they collide.
#pragma once

#include "core/scene/scene.hpp"

namespace carom {

// Some disk is this much faster than the root mean square of one component: sqrt(2 ln N) for N up to 10^6.
inline constexpr double fastest_share = 5.3;

// Estimated from the scene alone: the same for every run and machine. What the choice of a method rests on.
struct SceneScales {
  double disks = 0.0;            // sources included, all that they may emit
  double diameter = 0.0;         // of the root mean square radius
  double smallest_radius = 0.0;  // length
  double packing_fraction = 0.0;
  // Root mean square of one component, with what gravity adds while falling, walls that move give to disks at rest, and
  // rough disks get from their spins.
  double speed = 0.0;
  double fastest = 0.0;         // speed that hardly any disk goes beyond, of the lightest and of those that start so
  double vibration = 0.0;       // largest angular frequency of a wall that vibrates; 1 / time
  double collision_rate = 0.0;  // of a disk, per unit time: 4 (Z - 1) speed / (sqrt(pi) diameter)
  // Of a disk with sides, inner walls and fixed disks, per unit time: speed / sqrt(2 pi) times their length as the
  // disk's centre meets it, over the area that is left to centres.
  double wall_rate = 0.0;
  double restitution = 1.0;   // the least of two disks of any groups, at speeds where its law takes most
  double stopping = 0.0;      // where disks settle: what one loses that is stopped, over what a collision takes from it
  bool settles = false;       // gravity presses and contacts dissipate: in the end a pile
  bool driven = false;        // by walls that move: how fast disks become is known from a run alone
  bool may_collapse = false;  // infinitely many collisions in finite time are to be expected
};

// Compressibility P A / (N kT) of equal hard disks at a packing fraction below 1, good to 0.1 % up to 0.65 (virial
// series resummed; docs/reference_values.md).
double compressibility(double packing_fraction);

// Precondition: box and radii of the scene are known and good.
SceneScales scales_of(const Scene& scene);

}  // namespace carom
