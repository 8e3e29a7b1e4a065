// What resolving a contact needs to know of a step, and what it says of the contact.
#pragma once

#include <cstdint>

#include "core/base/types.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"
#include "core/disks/restitution_law.hpp"
#include "core/disks/roughness.hpp"

namespace carom {

// The constants of one step (or part of a step) that resolving needs.
struct StepRules {
  Domain box;
  Gravity gravity;
  double restitution = 1.0;
  double dt = 0.0;                        // length of the step just drifted
  bool settles = false;                   // gravity acts and a contact dissipates: contacts may bear load (resting.hpp)
  std::uint64_t seed = 0;                 // with thermal sides
  std::uint32_t* thermal_hits = nullptr;  // State::thermal_hits; a disk in contact changes its own
  int round = 0;  // of resolving within the step; later ones find what the one before pressed together
  const RestitutionLaw* law = nullptr;  // of disks, where `restitution` is not all
  const Surfaces* surfaces = nullptr;   // where disks are rough
};

// What became of one contact event.
struct Impact {
  double virial = 0.0;  // |impulse| x distance of a disk pair, |impulse| of a wall; mass length^2 / time or m l / t
  double energy = 0.0;  // that a thermal side, a wall that moves or a shear gave; mass length^2 / time^2
  bool happened = false;
  // Late, since the contact is older than the step; or made elastic by the TC model (exact).
  bool inaccurate = false;
  bool lost_energy = false;  // exact only
  bool sheared = false;      // two disks in a sheared box: there is `shear`
  bool pushed = false;       // by an inner wall that moves: `virial` and `shear` are the momentum, along x and y
  double shear = 0.0;        // in a sheared box: virial nx ny of two disks, n from one centre to the other
};

// What an inner wall that moves at `velocity` did to a disk whose velocity it changed from `before` to (vx, vy).
inline void see_push(Impact& impact, double mass, Vec2 velocity, Vec2 before, double vx, double vy) {
  impact.pushed = true;
  impact.virial = mass * (vx - before.x);
  impact.shear = mass * (vy - before.y);
  impact.energy = impact.virial * velocity.x + impact.shear * velocity.y;
}

}  // namespace carom
