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
  std::optional<double> time;  // simulated; the frame nearest to it
};                             // neither: the last frame

struct SceneFrame {
  std::vector<Vec2> positions, velocities;  // in order of id
  std::vector<double> radius, mass;
  std::vector<double> spin{};  // of rough disks; else empty
};

// Throws InputError, naming the file, where there is no such frame.
using FrameReader = std::function<SceneFrame(const FrameAsked&)>;

}  // namespace carom
