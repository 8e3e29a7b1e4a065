// The line of progress of a run.
#pragma once

#include <cstddef>
#include <string>

#include "app/cli/status_line.hpp"
#include "core/disks/state.hpp"

namespace carom {

// The progress of a run at some moment.
struct ProgressPoint {
  double elapsed = 0.0;  // wall time since the run's first step, in seconds
  double time = 0.0;     // simulated
  Count steps = 0;
};

// The text of the line: share done, simulated time, steps and disk-steps per second, time left. Rates are those since
// `then`: the beginning of a run, such as a pile that settles, may be faster than its end.
std::string progress_text(const ProgressPoint& then, const ProgressPoint& now, std::size_t disks, double t_end);

// The line of a run: updated on a terminal; elsewhere one line a minute.
class Progress {
 public:
  // start: the state from which the run begins or is resumed; disks: their number.
  Progress(bool wanted, double t_end, const State& start, Count disks, StatusPlace place = on_standard_error());

  // Updates the line, if it is time.
  void update(const State& state);

  // Removes the line, so that other text can be written.
  void clear() { line_.clear(); }

 private:
  StatusLine line_;
  double t_end_;
  Count disks_;                  // see progress.cpp
  double start_;                 // by the line's clock
  ProgressPoint older_, newer_;  // rates are taken since older_, which follows newer_ at some distance
};

}  // namespace carom
