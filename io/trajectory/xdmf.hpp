// The description beside trajectory.h5 by which ParaView and VisIt read it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace carom {

struct XdmfPlan {
  std::vector<double> times;  // of the frames
  Count places = 0;           // in a frame
  std::size_t width = 8;      // bytes of a coordinate
  int dimensions = 2;
  bool sizes_each_frame = false;  // radius and mass are written frame by frame
};

// Writes h5_path with .xdmf in place of .h5: a point for each place, with velocity, id, radius and mass. Throws
// RunError.
void write_xdmf(const std::string& h5_path, const XdmfPlan& plan);

}  // namespace carom
