// The position of one output of a run at a checkpoint.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/disks/state.hpp"

namespace carom {

// A file that grows by frames. bytes: its length; 0 for a format that needs only the number of frames.
struct FileMark {
  std::string name;  // in the run's folder
  Count frames = 0;
  std::uint64_t bytes = 0;
};

// Means over the time between two rows; 0 until some time has passed.
struct IntervalMeans {
  double pressure = 0.0;        // energy / area
  double collision_rate = 0.0;  // a disk; 1 / time
  double force[4] = {};         // outwards on each side
  double shear_stress = 0.0;    // energy / area
};

// The counters at the last row, from which the next means start, and the last means.
struct MeterMark {
  double counted_until = 0.0;
  Counters before;
  IntervalMeans means;
};

struct SeriesMark {
  FileMark file;
  MeterMark meter;
};

struct MovieMark {
  Count frames = 0;
  bool single_frames = false;      // PNG files in place of a movie
  std::vector<std::string> parts;  // files, each a movie, that make up all frames so far
  double low = 0.0, high = 1.0;    // the ends of the colour scale, set by the first frame
  int time_decimals = 2;
};

}  // namespace carom
