// The times of frames: the start, every multiple of an interval from there on, and the end.
#pragma once

#include <optional>

#include "core/base/types.hpp"

namespace carom {

// Frames at start + k * every for k = 0, 1, ..., and one at t_end. Times are products, never sums of intervals, so that
// the thousandth frame is as exact as the first.
class FrameSchedule {
 public:
  // every > 0, or 0 for the first and the last frame only. slack: tolerance by which a state may be too early for a
  // frame, in units of every. Time stepping may arrive at 0.29999999999999999 instead of 0.3, and that frame must not
  // wait for the next step.
  FrameSchedule(double every, double t_end, double slack, double start = 0.0);

  // The time of the next frame, if it is due in a run that has come to `now`.
  std::optional<double> due(double now) const;

  // To be called when a frame has been made of the state at `time` (the time asked for, or in time stepping the step's
  // end). All frames due until then are done, so that long steps do not show a state twice.
  void made(double time);

 private:
  double every_, t_end_, slack_, start_;
  double next_;  // time of the next frame
  bool finished_ = false;
};

// Number of frames from 0 to t_end, both included, if none is skipped.
Count frame_count(double every, double t_end);

}  // namespace carom
