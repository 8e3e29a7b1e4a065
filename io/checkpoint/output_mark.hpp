// Where the outputs of a run stand at a checkpoint. Every output offers two things: mark(), which brings what it has
// written onto the disk and says where it is, and a constructor that takes a mark, cuts off what came after it and goes
// on. A new kind of output needs a mark here and a line in checkpoint_fields.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/measure/analysis.hpp"
#include "core/measure/displacement.hpp"
#include "io/files/file_mark.hpp"
#include "io/plots/plot.hpp"

namespace carom {

// All outputs of a run. What a scene does not ask for is absent.
struct OutputMark {
  Count frames = 0;
  double last_time = 0.0;  // simulated time of the last frame
  std::optional<FileMark> trajectory;
  std::optional<SeriesMark> series;
  MeterMark meter;  // for a trajectory that shows what series.csv would
  std::optional<MovieMark> movie;
  VelocityRecord velocities;
  EnergyRecord energies;
  std::optional<AnalysisRecord> analysis;  // the file is made anew from it
  DisplacementTally rounds;                // of the disks in a trajectory, round the periodic sides
};

// A file (or the folder "frames") that must be there for a run to go on, with so many bytes or more.
struct MarkedFile {
  std::string name;
  std::uint64_t bytes = 0;
};
std::vector<MarkedFile> files_of(const OutputMark& mark);

}  // namespace carom
