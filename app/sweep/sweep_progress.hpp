// The line of progress of a sweep.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "app/cli/status_line.hpp"
#include "core/base/short_number.hpp"

namespace carom {

// How many runs have ended and how long the rest will take: kept up to date as that of a run (progress.hpp).
class SweepProgress {
 public:
  // all: runs that are left when it begins.
  explicit SweepProgress(std::size_t all) : all_(all), start_(line_.seconds()) {}

  // Brings the line up to date, if it is time. ended: those that failed as well.
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

  // Takes the line away, so that something else can be written.
  void clear() { line_.clear(); }

 private:
  StatusLine line_{true};
  std::size_t all_;
  double start_;
};

}  // namespace carom
