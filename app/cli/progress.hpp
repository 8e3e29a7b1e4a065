// The line of progress of a run.
#pragma once

#include <cstddef>
#include <string>

#include "app/cli/status_line.hpp"
#include "core/disks/state.hpp"

namespace carom {

// How far a run was at some moment.
struct ProgressPoint {
  double elapsed = 0.0;  // wall time since the run's first step, in seconds
  double time = 0.0;     // simulated
  Count steps = 0;
};

// What the line says: share done, simulated time, steps and disk-steps a second, time left. Rates are those since
// `then`: a pile that settles becomes slower, and its beginning says nothing of its end.
std::string progress_text(const ProgressPoint& then, const ProgressPoint& now, std::size_t disks, double t_end);

// The line of a run: kept up to date on a terminal, a line a minute elsewhere.
class Progress {
 public:
  // start: the state that the run begins or goes on from, with so many disks.
  Progress(bool wanted, double t_end, const State& start, Count disks, StatusPlace place = on_standard_error());

  // Brings the line up to date, if it is time.
  void update(const State& state);

  // Takes the line away, so that something else can be written.
  void clear() { line_.clear(); }

 private:
  StatusLine line_;
  double t_end_;
  Count disks_;                  // see progress.cpp
  double start_;                 // by the line's clock
  ProgressPoint older_, newer_;  // rates are taken since older_, which follows newer_ at some distance
};

}  // namespace carom
