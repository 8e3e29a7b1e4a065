// One window of the exact method: its start, length and end, and the checks that time advances.
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
  double end = 0.0;          // absolute time; exactly that of the cut (next_cut) if the window ends at one
  double meant = 0.0;        // length before a cut shortened it
  double least = 0.0;        // least length, except after a crowded window
  double pace = 0.0;         // mean length of crowded windows below which time nearly stands still
  double pace_moving = 0.0;  // the same where moving walls push disks
  bool tc = false;           // the TC model makes collisions elastic
  Count disks = 0;           // at its start
};

// Does the TC model make collisions elastic? False if all are elastic anyway, even if the scene sets the model.
bool has_tc(const Scene& scene);

// The rules of a window that starts at time `start`, with moving walls at their places then.
ExactRules exact_rules(const Scene& scene, const Disks& disks, double start);

// Plans the window that starts at state.time, from state.window, the number of all disks (state may hold only some of
// them) and their speeds. scale: factor of the lengths of windows, for tests. Throws PhysicsError if time no longer
// advances.
WindowPlan plan_window(const Scene& scene, const State& state, std::size_t disks, const SpeedSummary& speeds,
                       double scale = 1.0);

// The replacement of a window that became crowded (window_length.hpp) at event `last`: it ends half-way to that event.
// Throws PhysicsError if time cannot be divided any further.
WindowPlan shortened(const WindowPlan& plan, const ExactRules& rules, const EventMark& last);

// Ends a window: sets time, counters and the planned length of the next window. disks: their number now.
void finish_window(State& state, std::size_t disks, const WindowPlan& plan, const ImpactTally& tally,
                   double scale = 1.0);

// To be called after finish_window: throws PhysicsError if a series of crowded windows has hardly advanced time.
void check_pace(const Scene& scene, State& state, const WindowPlan& plan, const ImpactTally& tally);

// Throws the PhysicsError of an inelastic collapse at this event. start: of the window.
[[noreturn]] void fail_collapse(const ExactRules& rules, const EventMark& event, double start);

}  // namespace carom
