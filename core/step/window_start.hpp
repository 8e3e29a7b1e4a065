// Between two windows of the exact method sources emit, Brownian velocities are drawn and a thermostat kicks: when that
// happens, and the times at which windows must end for it.
#pragma once

#include <functional>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The latest time at which the window from state.time may end: the earliest of the end of the run, the next try of a
// source, the end of the Brownian interval, the next kick of the thermostat, and the end of a piece of a wall's motion.
double next_cut(const Scene& scene, const State& state);

// Every source with an emission time at state.time, up to rounding, emits the disks that are due, each at the first of
// 32 places that has room. A disk that finds none waits and is tried again: at the source's emission times, and, while
// fewer than eight wait, at a quarter, a half and three quarters of the time in between. Nothing here depends on where
// other windows end. Done only once before a window (State::step_begun), even if the window is begun again: a second
// call would draw other places, since ids have been used up.
void emit_at_window_start(const Scene& scene, State& state, const std::function<bool(const Disk&)>& room);

// Is a Brownian interval due to begin at state.time?
bool brownian_interval_begins(const Scene& scene, const State& state);

// Counts the interval and returns its number and length.
struct BrownianInterval {
  Count number = 0;
  double length = 0.0;  // time
};
BrownianInterval begin_brownian_interval(const Scene& scene, State& state);

}  // namespace carom
