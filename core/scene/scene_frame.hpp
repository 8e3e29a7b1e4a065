// A frame of an earlier run, for a scene that starts from it. Trajectories are read in io/: the caller that loads a
// scene passes the reader.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace carom {

struct FrameAsked {
  std::string path;            // a trajectory, or the folder of a run
  std::optional<Count> index;  // counted from 1
  std::optional<double> time;  // simulated; the frame nearest to it; with neither the last frame
  bool velocities = false;     // are velocities wanted, and shear and Brownian motion of their run?
  std::string group = {};      // group of the wanted disks in that run; empty: all disks
};

struct SceneFrame {
  std::vector<Vec2> positions, velocities;  // in order of id
  std::vector<double> radius, mass;
  std::vector<double> spin{};  // of rough disks; else empty
  // If velocities are wanted: the rate of the flow vx = rate (y - height / 2) that they include (core/disks/shear.hpp);
  // 0 without shear, absent if it is not known.
  std::optional<double> shear_rate = 0.0;
  double height = 0.0;    // of the box of that run
  bool brownian = false;  // velocities are u / dt of a run with Brownian motion, if its scene.toml tells
};

// Throws InputError, naming the file, if there is no such frame.
using FrameReader = std::function<SceneFrame(const FrameAsked&)>;

}  // namespace carom
