// What carom check predicts of a run from its scene and its start.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// How long a step may be; infinite where nothing limits it.
struct StepForesight {
  double at_start = 0.0;       // with the speeds of the start no disk moves further than it safely may
  double later = 0.0;          // nor with those after falling to the floor, of sources, and from walls and baths
  bool driven = false;         // walls that move, thermal sides or a thermostat give speeds of their own
  double landing_speed = 0.0;  // the largest after a fall; 0 without gravity
  double resting = 0.0;        // a disk of a pile falls by less than the overlap that a pile may have; infinite if none
  double safe() const;
};

// How many disks there will be, sinks left aside.
struct Population {
  double start = 0.0, mean = 0.0, end = 0.0;
  double fill = 0.0;  // area of all disks at the end over that of the box
};

struct CollapseForesight {
  bool expected = false;
  std::optional<double> from;  // simulated time, where it can be predicted
};

// A trial of the first steps. The first one makes lists and takes memory, eight times what others take of 10^6 disks
// with exact: what a run goes on with are the others.
struct StepTrial {
  double first_seconds = 0.0, first_end = 0.0;  // of the first step: wall time, and the simulated time at its end
  double seconds = 0.0, end = 0.0;              // of all of them
  double slowing = 0.0;                         // k: what is to pay for goes as ln(1 + k t), as t where that is 0
  double seconds_to(double t_end) const;        // of all steps to there; infinite where the trial came nowhere
};

// k of collisions that grow as ln(1 + k t), by Haff's law where a gas cools, and at most so where it loses its disks.
// half, end: two times; the counts: of collisions up to each. 0 where there are too few to tell, or they are as
// frequent as before.
double slowing_of_collisions(double half, Count count_half, double end, Count count_end);

StepForesight foresee_steps(const Scene& scene, const Disks& start);
Population foresee_population(const Scene& scene, const Disks& start);
CollapseForesight foresee_collapse(const Scene& scene, const Disks& start);

// What will go wrong, and the remedy: one sentence each.
std::vector<std::string> foreseen_troubles(const Scene& scene, const StepForesight& steps, const Population& population,
                                           const CollapseForesight& collapse);

// Does the run step by dt? The exact method leaves it unused, except as the step of Brownian motion.
bool uses_dt(const Scene& scene);

}  // namespace carom
