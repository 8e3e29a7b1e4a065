#include "io/trajectory/scene_frame_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "core/base/input_message.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

namespace {

std::string trajectory_of(const std::string& path) {
  if (!std::filesystem::exists(path)) fail_input(path, "does not exist", "expected a folder of a run, or a trajectory");
  if (!std::filesystem::is_directory(path)) return path;
  const std::string found = trajectory_in(path).string();
  if (found.empty()) fail_input(path, "holds no trajectory.xyz or trajectory.h5", "expected a run with a trajectory");
  return found;
}

}  // namespace

SceneFrame read_scene_frame(const FrameAsked& asked) {
  const std::string path = trajectory_of(asked.path);
  const auto reader = open_trajectory(path);
  TrajectoryFrame frame, chosen;
  Count frames = 0;
  while (!(asked.index && frames == *asked.index) && reader->read(frame)) {
    ++frames;
    const bool nearer = asked.time && std::abs(frame.time - *asked.time) >= std::abs(chosen.time - *asked.time);
    if (frames == 1 || !nearer) std::swap(chosen, frame);
  }
  if (frames == 0) fail_input(path, "holds no frame");
  if (asked.index && frames < *asked.index) {
    fail_input(path, fmt::format("there is no frame {}", *asked.index), fmt::format("expected 1 to {}", frames));
  }
  SceneFrame result;
  const Disks& d = chosen.disks;
  for (std::size_t i = 0; i < d.size(); ++i) {
    result.positions.push_back({d.x[i], d.y[i]});
    result.velocities.push_back({d.vx[i], d.vy[i]});
  }
  result.radius = std::move(chosen.disks.radius);
  result.mass = std::move(chosen.disks.mass);
  result.spin = std::move(chosen.disks.spin);
  return result;
}

}  // namespace carom
