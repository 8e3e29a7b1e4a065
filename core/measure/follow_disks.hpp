// When to look where disks are, so that none goes half round a periodic box unseen.
#pragma once

#include <string>
#include <string_view>

#include "core/measure/displacement.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"

namespace carom {

// Brings the tally up to time t, start of the engine's last step <= t <= its state's time; to be called after each
// step, and for every time at which displacements are wanted, in order of time. The largest speed, seen at ends of
// steps and on paths within them, says how far a disk can have come since the last look; a step so long that a quarter
// of the period is within reach is looked at in between, as far as the engine knows its paths. Where it does not, the
// tally counts a doubt. Returns whether the disks at t themselves are due for a look now.
bool follow_disks(DisplacementTally& tally, const Engine& engine, const Scene& scene, double t);

// What a run says of the first doubt. what: that is measured; wrong: what may be; every: the key of the time between
// looks of that, which an exact run may have as short as it takes.
std::string doubt_text(const DisplacementTally& tally, const Scene& scene, std::string_view what,
                       std::string_view wrong, std::string_view every);

}  // namespace carom
