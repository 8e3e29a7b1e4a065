// A frame of an earlier run, as a scene that starts from it asks for it. Trajectories are read elsewhere (io/): the
// caller that loads a scene brings the reader.
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
  bool velocities = false;     // are its velocities wanted, and what run they are of?
  std::string group = {};      // the name that the disks wanted had in the run; empty: all disks
};

struct SceneFrame {
  std::vector<Vec2> positions, velocities;  // in order of id
  std::vector<double> radius, mass;
  std::vector<double> spin{};  // of rough disks; else empty
  // Where velocities are wanted: of the flow vx = rate (y - height / 2) that a run with a shear writes in its
  // velocities (core/disks/shear.hpp); 0 without one, absent where nothing tells.
  std::optional<double> shear_rate = 0.0;
  double height = 0.0;    // of the box of that run
  bool brownian = false;  // velocities are u / dt of a run with Brownian motion, as far as its scene.toml tells
};

// Throws InputError, naming the file, where there is no such frame.
using FrameReader = std::function<SceneFrame(const FrameAsked&)>;

}  // namespace carom
