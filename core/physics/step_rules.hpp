// Input and output of resolving a contact: the rules of a step, and the impact of a contact.
#pragma once

#include <cstdint>
#include <variant>

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
  int round = 0;                          // number of the round of finding and resolving contacts within the step
  const RestitutionLaw* law = nullptr;    // of disks, where `restitution` is not all
  const Surfaces* surfaces = nullptr;     // where disks are rough
  double whole_dt = 0.0;                  // length of a whole step, if this one may be shorter
};

// The outcome of a contact of two disks.
struct PairImpact {
  double virial = 0.0;  // |impulse| x distance of the centres; mass length^2 / time
  bool happened = false;
  // Late, since the contact is older than the step; or made elastic by the TC model (exact).
  bool inaccurate = false;
  bool lost_energy = false;   // exact only
  bool sheared = false;       // the box is sheared: the next two members are set
  double shear_virial = 0.0;  // virial nx ny, n from one centre to the other; mass length^2 / time
  double shear_work = 0.0;    // that the shear did, by crossings of exact too; mass length^2 / time^2
};

// The outcome of a contact of a disk and a side or an obstacle.
struct WallImpact {
  double impulse = 0.0;  // its size; mass length / time
  double energy = 0.0;   // from a thermal side, a wall that moves or a shear at a crossing; mass length^2 / time^2
  bool happened = false;
  bool inaccurate = false;   // as of two disks
  bool lost_energy = false;  // likewise
  bool pushed = false;       // by a moving inner wall: `momentum` is set
  Vec2 momentum{};           // that the wall gave; mass length / time
};

// Of either kind.
using Impact = std::variant<PairImpact, WallImpact>;

inline bool has_happened(const Impact& impact) {
  return std::visit([](const auto& one) { return one.happened; }, impact);
}

// Enters momentum and work of an inner wall with this velocity, which changed a disk's velocity from `before` to (vx,
// vy).
inline void record_push(WallImpact& impact, double mass, Vec2 velocity, Vec2 before, double vx, double vy) {
  impact.pushed = true;
  impact.momentum = {mass * (vx - before.x), mass * (vy - before.y)};
  impact.energy = impact.momentum.x * velocity.x + impact.momentum.y * velocity.y;
}

}  // namespace carom
