// When to note the positions of disks, so that every crossing of a periodic box is counted.
#pragma once

#include <string>
#include <string_view>

#include "core/measure/displacement.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"

namespace carom {

// Brings the tally up to time t, which lies within the engine's last step. To be called after each step, and for every
// time at which displacements are wanted, in order of time. The largest speed, at ends of steps and on paths within
// them, bounds how far a disk can have moved since positions were last noted. If that may be more than a quarter of the
// period within a step, positions are noted at times in between, if the engine keeps paths; otherwise the tally counts
// a doubtful move. Returns whether the positions at t have to be noted now.
bool follow_disks(DisplacementTally& tally, const Engine& engine, const Scene& scene, double t);

// The warning about the first doubtful move. what: the measured quantity; wrong: what may be wrong with it; every: the
// key of its sampling interval, which can be shortened in an exact run.
std::string doubt_text(const DisplacementTally& tally, const Scene& scene, std::string_view what,
                       std::string_view wrong, std::string_view every);

}  // namespace carom
