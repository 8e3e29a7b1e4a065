// One window of the exact method: where it lies in time.
#pragma once

#include "core/exact_event.hpp"
#include "core/impact_tally.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "core/window_length.hpp"

namespace carom {

struct WindowPlan {
  double start = 0.0;   // absolute time
  double length = 0.0;  // > 0
  double end = 0.0;     // absolute time; a cut's own value where the window ends at one
  double meant = 0.0;   // length before a cut shortened it
};

ExactRules exact_rules(const Scene& scene, const Disks& disks);

// The window that starts at state.time, from state.window and the disks' speeds. scale: 1, or what a test multiplies
// windows by. Throws PhysicsError when time no longer advances.
WindowPlan plan_window(const Scene& scene, const State& state, const SpeedSummary& speeds, double scale);

// The window is over: time, counters and the length meant for the next one.
void finish_window(State& state, const WindowPlan& plan, const ImpactTally& tally, double scale);

// The one line about disks id1 and id2 (a wall, perhaps) whose collisions pile up at a time. Status 3.
[[noreturn]] void fail_collapse(DiskId id1, DiskId id2, double time);

}  // namespace carom
