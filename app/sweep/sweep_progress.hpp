// The line of progress of a sweep.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "app/cli/status_line.hpp"
#include "core/base/short_number.hpp"

namespace carom {

// The number of runs that have ended and the time for the rest: updated as the line of a run (progress.hpp).
class SweepProgress {
 public:
  // all: number of runs left at the beginning.
  explicit SweepProgress(std::size_t all) : all_(all), start_(line_.seconds()) {}

  // Updates the line, if it is time. ended: including those that failed.
  void update(std::size_t ended, std::size_t failed) {
    if (!line_.due()) return;
    std::string text = fmt::format("{} of {} runs done", ended - failed, all_);
    if (failed > 0) text += fmt::format(", {} failed", failed);
    if (ended > 0) {
      const double each = (line_.seconds() - start_) / static_cast<double>(ended);
      text += fmt::format("  {} left", duration_text(each * static_cast<double>(all_ - ended)));
    }
    line_.show(text);
  }

  // Removes the line, so that something else can be written.
  void clear() { line_.clear(); }

 private:
  StatusLine line_{true};
  std::size_t all_;
  double start_;
};

}  // namespace carom
