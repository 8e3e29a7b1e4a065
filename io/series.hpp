// series.csv: the run in numbers, one row a frame.
#pragma once

#include <string>

#include "core/disks.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/output_file.hpp"
#include "io/output_mark.hpp"

namespace carom {

class SeriesWriter {
 public:
  // Writes the heading. Throws RunError where the file cannot be written, here and below.
  SeriesWriter(const std::string& path, const Scene& scene);

  // Goes on behind a mark in a file that is there; what follows it is cut off. Throws InputError where the file is
  // shorter.
  SeriesWriter(const std::string& path, const Scene& scene, const SeriesMark& from);

  // One row: disks at `time`, and what `now` has counted. An exact run counts to the end of its window, which may lie
  // a little after `time`; intervals are taken between the states, so that no collision is lost or counted twice.
  // pressure, collision_rate (per disk) and the four wall forces are means over the time since the row before, and 0
  // in the first row.
  void write(const Disks& disks, double time, const State& now);

  // Where the file has come to; all up to there is on the disk.
  SeriesMark mark();

  void close() { file_.close(); }

 private:
  OutputFile file_;
  Domain box_;
  double gravity_;
  Count rows_ = 0;
  double counted_until_ = 0.0;
  Counters before_;
};

}  // namespace carom
