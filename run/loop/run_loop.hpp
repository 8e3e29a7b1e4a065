// From the first step to the last, with frames on the way.
#pragma once

#include <functional>
#include <optional>

#include "core/step/engine.hpp"

namespace carom {

// Functions that are called during a run; each may be empty. Output never changes the state.
struct RunObserver {
  // A frame: the disks and their time. The first is at 0, the last at t_end, none comes twice.
  std::function<void(const DisksInPieces&)> frame;
  // A moment of scene.analysis: the first at its start, the last at t_end. Frames and moments come in order of time; of
  // two of the same time, the moment.
  std::function<void(const DisksInPieces&)> sample;
  // After each step, and after the frames and moments that lie in it.
  std::function<void()> stepped;
  // Between steps, about a hundred times a second, and once more at the end, with the seconds spent in steps so far.
  // All frames that are due have been made then. Returns whether to go on.
  std::function<bool(double)> pulse;
  // Asked within long steps too, by any thread: may the step go on? Where not, the run stands where its last whole step
  // ended, and pulse is asked.
  std::function<bool()> go_on;
  // Time of the last frame (moment) that was made before, in a run that goes on from a checkpoint.
  std::optional<double> last_frame, last_sample;
};

// Steps the engine to scene.run.t_end, or until pulse() says no. Returns the wall time spent in the steps alone, in
// seconds. Throws what the engine and the observer throw.
double run_to_end(Engine& engine, const Scene& scene, const RunObserver& observer);

}  // namespace carom
