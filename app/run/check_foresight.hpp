// The predictions of carom check about a run, from its scene and initial state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Bounds on the step; infinite if nothing limits it.
struct StepForesight {
  double at_start = 0.0;  // longest step in which no disk moves further than safe_travel, with the initial speeds
  double later = 0.0;     // the same with speeds after falling to the floor, of sources, and given by walls and baths
  bool driven = false;    // moving walls, thermal sides or a thermostat give speeds
  double landing_speed = 0.0;  // largest speed after a fall; 0 without gravity
  double resting = 0.0;  // longest step in which a disk of a pile falls by less than the overlap that a pile may have
  double safe() const;
};

// The number of disks in the run, without regard to sinks.
struct Population {
  double start = 0.0, mean = 0.0, end = 0.0;
  double fill = 0.0;  // area of all disks at the end over that of the box
};

struct CollapseForesight {
  bool expected = false;
  std::optional<double> from;  // simulated time, where it can be predicted
};

// A trial of the first steps. The first step makes lists and allocates memory (for 10^6 disks with exact it takes eight
// times as long as others), so the cost of a run is estimated from the others.
struct StepTrial {
  double first_seconds = 0.0, first_end = 0.0;  // of the first step: wall time, and the simulated time at its end
  double seconds = 0.0, end = 0.0;              // of all of them
  double slowing = 0.0;                         // k: the cost grows as ln(1 + k t), or as t if k is 0
  double seconds_to(double t_end) const;        // of all steps to t_end; infinite if the trial did not advance
};

// k of collisions whose number grows as ln(1 + k t), as by Haff's law in a cooling gas. half, end: two times; the
// counts: collisions up to each. 0 if there are too few collisions, or their rate does not fall.
double slowing_of_collisions(double half, Count count_half, double end, Count count_end);

StepForesight foresee_steps(const Scene& scene, const Disks& start);
Population foresee_population(const Scene& scene, const Disks& start);
CollapseForesight foresee_collapse(const Scene& scene, const Disks& start);

// The foreseen problems and their remedies, one sentence each.
std::vector<std::string> foreseen_troubles(const Scene& scene, const StepForesight& steps, const Population& population,
                                           const CollapseForesight& collapse);

// Does the run use dt? The exact method does so only with Brownian motion.
bool uses_dt(const Scene& scene);

}  // namespace carom
