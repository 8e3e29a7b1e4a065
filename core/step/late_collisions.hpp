// The warnings about inaccurate collisions, if their share is above its bound (core/step/validity.hpp): collisions that
// time stepping resolves a step late, or at the same moment as another of the same disk, or that the TC model makes
// elastic.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Is inaccurate / all above this share?
bool exceeds(Count inaccurate, Count all, double share);

// The number of all collisions of the kind of which some may be inaccurate.
Count collisions_watched(const Scene& scene, const State& state);

// The words " or run.method = \"exact\"" for the end of a remedy; empty with Brownian motion, which the exact method
// also draws once a step.
const char* or_exact(const Scene& scene);

// One line with their number so far, the cause and the remedy.
std::string inaccurate_text(const Scene& scene, const State& state);
std::string late_at_walls_text(const Scene& scene, const State& state);

// For the end of a run of time stepping: the warnings about inaccurate collisions whose share is too large, but whose
// number stayed too small (least_inaccurate) for a warning during the run. A single collision gives none; a single late
// bounce off a wall does.
std::vector<std::string> few_inaccurate_warnings(const Scene& scene, const State& state);

}  // namespace carom
