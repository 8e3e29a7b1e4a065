// When frames are due: at the start, at every multiple of an interval from there on, and at the end.
#pragma once

#include <optional>

#include "core/base/types.hpp"

namespace carom {

// Frames at start + k * every for k = 0, 1, ..., and one at t_end. The times are of products, never sums of intervals,
// so that the thousandth frame is as punctual as the first.
class FrameSchedule {
 public:
  // every > 0, or 0 for the first and the last frame only. slack is how much too early, in units of every, a state
  // may be and still count: time stepping adds up dt and arrives at 0.3 as 0.29999999999999999, which must not wait
  // for the next step.
  FrameSchedule(double every, double t_end, double slack, double start = 0.0);

  // Time of the next frame that is due in a run that has come to `now`, none if there is none yet.
  std::optional<double> due(double now) const;

  // A frame has been made of the state at `time` (the time asked for, or the step's end for time stepping). All frames
  // due up to there are done, so that long steps do not show one state twice.
  void made(double time);

 private:
  double every_, t_end_, slack_, start_;
  double next_;  // time of the next frame
  bool finished_ = false;
};

// Number of frames from 0 to t_end, both included, if none is skipped.
Count frame_count(double every, double t_end);

}  // namespace carom
