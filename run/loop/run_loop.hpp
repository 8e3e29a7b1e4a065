// Runs an engine from the first step to the last, with frames and samples in between.
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
  // Called between steps, about a hundred times a second, and once more at the end, with the seconds spent in steps so
  // far, when all due frames have been made. Returns whether to go on.
  std::function<bool(double)> pulse;
  // Called within long steps, by any thread: may the step go on? If not, the run returns to the end of its last whole
  // step, and pulse is called.
  std::function<bool()> go_on;
  // In a resumed run: the time of the last frame (sample) before it.
  std::optional<double> last_frame, last_sample;
};

// Steps the engine to scene.run.t_end, or until pulse() says no. Returns the wall time spent in the steps alone, in
// seconds. Throws what the engine and the observer throw.
double run_to_end(Engine& engine, const Scene& scene, const RunObserver& observer);

}  // namespace carom
