// The figures that the suite measures in a run, by name, from the start, the end and what was seen in between.
#pragma once

#include <string>

#include "core/disks/state.hpp"
#include "core/measure/invariants.hpp"
#include "core/scene/scene.hpp"

namespace carom::stability {

// The worst figures of a run, taken after some of its steps and at its end.
struct Worst {
  double overlap = 0.0;       // of two disks, over the sum of radii
  double wall_overlap = 0.0;  // over the radius
  double energy_drift = 0.0;  // |E / E(0) - 1|
  double energy_gain = 0.0;   // E / E(0) - 1, where positive
  double momentum = 0.0;      // |P - P(0)| over the sum of m |v|
  Count outside = 0;          // centres outside the box, or not finite

  void look(const Scene& scene, const State& start, const State& now);
};

// A run that has ended or was stopped.
struct Measured {
  const Scene& scene;
  const State& start;
  const State& end;
  const Worst& worst;
};

// Names: time, advance (of a step, in dt), collisions, events (with walls), rate (disk collisions a disk and unit
// time), energy_drift, energy_gain, energy (end over start), kinetic (end over start), unrest (kinetic at
// the end over all energy at the start), momentum, overlap, wall_overlap,
// outside, passed (pairs that were left and right of each other and have changed places), x0, y0, vx0, vy0 (of the disk
// with id 0, and so on), kinetic_now (energy), fastest (largest speed at the end), disks, lean (largest |x - x(0)|).
// Throws InputError for any other name.
double measure(const std::string& what, const Measured& run);

}  // namespace carom::stability
