// What happens between two windows of the exact method: sources emit, Brownian velocities are drawn, a thermostat
// kicks; and the times at which a window must end for that.
#pragma once

#include <functional>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Earliest time after state.time at which a window must end: the end of the run, the next time at which a source that
// has disks left tries one, the end of the Brownian interval, the thermostat's next kick, the end of a piece of the
// motion of a side or an inner wall.
double next_cut(const Scene& scene, const State& state);

// Every source whose emission time is state.time, but for rounding, emits what is due, each disk at the first of 32
// places that has room. What finds none waits, and is tried again: at the source's emission times, and while fewer than
// eight wait at a quarter, a half and three quarters of the time in between. Nothing here depends on where other
// windows end. Once only before a window (State::step_begun), even where that is begun again: of several sources, the
// first would try the id that a later one has given away with the next one's places.
void emit_at_window_start(const Scene& scene, State& state, const std::function<bool(const Disk&)>& room);

// Is a Brownian interval due to begin at state.time?
bool brownian_interval_begins(const Scene& scene, const State& state);

// Begins it: counts it and gives its number and length.
struct BrownianInterval {
  Count number = 0;
  double length = 0.0;  // time
};
BrownianInterval begin_brownian_interval(const Scene& scene, State& state);

}  // namespace carom
