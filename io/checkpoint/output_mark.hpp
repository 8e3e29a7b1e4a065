// The positions of the outputs of a run at a checkpoint. Every output has a function mark(), which writes its data to
// the disk and returns its position, and a constructor from a mark, which cuts off all later data and continues. A new
// kind of output needs a mark here and a line in checkpoint_fields.hpp.
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

// All outputs of a run; those that the scene does not ask for are absent.
struct OutputMark {
  Count frames = 0;
  double last_time = 0.0;  // simulated time of the last frame
  std::optional<FileMark> trajectory;
  std::optional<SeriesMark> series;
  MeterMark meter;  // for the observables of trajectory.h5
  std::optional<MovieMark> movie;
  VelocityRecord velocities;
  EnergyRecord energies;
  std::optional<AnalysisRecord> analysis;  // analysis.h5 is written anew from it
  DisplacementTally rounds;                // of the disks in a trajectory, across periodic sides
};

// A file (or the folder "frames") that a resumed run needs, with at least this size.
struct MarkedFile {
  std::string name;
  std::uint64_t bytes = 0;
};
std::vector<MarkedFile> files_of(const OutputMark& mark);

}  // namespace carom
