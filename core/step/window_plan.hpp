// One window of the exact method: where it lies in time.
#pragma once

#include <cstddef>

#include "core/disks/state.hpp"
#include "core/physics/exact_event.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/scene/scene.hpp"
#include "core/step/window_length.hpp"

namespace carom {

struct WindowPlan {
  double start = 0.0;        // absolute time
  double length = 0.0;       // > 0
  double end = 0.0;          // absolute time; a cut's own value where the window ends at one
  double meant = 0.0;        // length before a cut shortened it
  double least = 0.0;        // length below which windows go only after crowded ones
  double pace = 0.0;         // mean length of windows below which time all but stands still
  double pace_moving = 0.0;  // likewise where walls that move push disks
  bool tc = false;           // the TC model makes collisions elastic
  Count disks = 0;           // at its start
};

// Does the TC model make collisions elastic? Not where all are, whatever the scene says.
bool has_tc(const Scene& scene);

// start: of the window, when moving sides are where the rules say.
ExactRules exact_rules(const Scene& scene, const Disks& disks, double start);

// The window that starts at state.time, from state.window, the number of all disks (state may have only some of them)
// and their speeds. scale: what tests multiply the lengths of windows by. Throws PhysicsError when time no longer
// advances.
WindowPlan plan_window(const Scene& scene, const State& state, std::size_t disks, const SpeedSummary& speeds,
                       double scale = 1.0);

// What takes the place of a window that proved to be crowded (window_length.hpp) with event `last`: half the way to
// that event. Throws PhysicsError where time cannot be divided any further.
WindowPlan shortened(const WindowPlan& plan, const ExactRules& rules, const EventMark& last);

// The window is over: time, counters and the length meant for the next one. disks: how many there are now.
void finish_window(State& state, std::size_t disks, const WindowPlan& plan, const ImpactTally& tally,
                   double scale = 1.0);

// After finish_window: throws PhysicsError when a row of crowded windows has hardly advanced time.
void check_pace(const Scene& scene, State& state, const WindowPlan& plan, const ImpactTally& tally);

// The one line about two disks (or a disk and a wall) whose collisions pile up. start: of the window. Status 3.
[[noreturn]] void fail_collapse(const ExactRules& rules, const EventMark& event, double start);

}  // namespace carom
