#include "io/trajectory/scene_frame_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/load/scene_file.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/drawn_velocities.hpp"
#include "io/files/output_folder.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

namespace {

std::string trajectory_of(const std::string& path) {
  check_present(path);
  if (!std::filesystem::is_directory(path)) return path;
  const std::string found = trajectory_in(path).string();
  if (!found.empty()) return found;
  const std::filesystem::path unfinished = trajectory_in(std::filesystem::path(path) / unfinished_name);
  if (!unfinished.empty()) {  // in it the last frame changes while the run goes on
    fail_input(path, "holds a run that is not finished",
               fmt::format("expected a finished one, or the trajectory {}", unfinished.string()));
  }
  fail_input(path, "holds no trajectory.xyz or trajectory.h5", "expected a run with a trajectory");
}

// The scene of the run that wrote a frame: the scene.toml beside the trajectory, if that exists and belongs to it.
std::optional<Scene> scene_of(const std::string& trajectory, const TrajectoryFrame& frame) {
  const std::filesystem::path file = std::filesystem::path(trajectory).parent_path() / "scene.toml";
  if (!std::filesystem::exists(file)) return {};
  try {
    Scene scene = load_scene(file.string());
    if (is_in_box(frame, scene.box)) return scene;
  } catch (const InputError&) {
  }
  return {};
}

// Times of frames are sums and products of steps: 0.3 may be 0.30000000000000004.
constexpr double frame_time_slack = 1e-9;

// A time before the first frame or after the last one cannot be meant for any frame.
void check_time(const std::string& path, double asked, double first, double last) {
  const double slack = frame_time_slack * std::abs(asked);
  if (asked >= first - slack && asked <= last + slack) return;
  fail_input(path, fmt::format("has no frame at t = {:g}", asked),
             fmt::format("expected a time from {:g} to {:g}, that of the last frame", first, last));
}

// The shear rate, absent if it is not known. A shear requires a box that is periodic in both directions, and a run in
// such a box without a shear counts rounds.
std::optional<double> shear_rate_of(const std::optional<Scene>& scene, const TrajectoryFrame& frame) {
  if (!frame.box.periodic_x() || !frame.box.periodic_y() || !frame.image_x.empty()) return 0.0;
  return scene ? std::optional(scene->box.shear.rate) : std::nullopt;
}

// Which disks of the frame are chosen: all, or those of the group that its run gave this name.
std::vector<bool> members_of(const std::string& path, const TrajectoryFrame& frame, const std::optional<Scene>& scene,
                             const std::string& name) {
  std::vector<bool> members(frame.disks.size(), true);
  if (name.empty()) return members;
  const std::string unknown = fmt::format("does not know a group \"{}\"", name);
  if (!scene) fail_input(path, unknown, "expected the folder of a run, with its scene.toml");
  std::string names;
  for (const NamedGroup& group : named_groups(*scene)) {
    names += (names.empty() ? "" : ", ") + group.name;
    if (group.name != name) continue;
    for (std::size_t i = 0; i < members.size(); ++i) members[i] = group.ids.holds(frame.disks.id[i]);
    return members;
  }
  fail_input(path, unknown, names.empty() ? "expected a run whose groups have names" : "expected one of " + names);
}

SceneFrame disks_of(const Disks& d, const std::vector<bool>& members) {
  SceneFrame result;
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (!members[i]) continue;
    result.positions.push_back({d.x[i], d.y[i]});
    result.velocities.push_back({d.vx[i], d.vy[i]});
    result.radius.push_back(d.radius_of(i));
    result.mass.push_back(d.mass_of(i));
    if (!d.spin.empty()) result.spin.push_back(d.spin[i]);
  }
  return result;
}

}  // namespace

SceneFrame read_scene_frame(const FrameAsked& asked) {
  const std::string path = trajectory_of(asked.path);
  const auto reader = open_trajectory(path);
  TrajectoryFrame frame, chosen;
  Count frames = 0;
  double first = 0.0, last = 0.0;
  while (!(asked.index && frames == *asked.index) && reader->read(frame)) {
    if (++frames == 1) first = frame.time;
    last = frame.time;
    const bool nearer = asked.time && std::abs(frame.time - *asked.time) >= std::abs(chosen.time - *asked.time);
    if (frames == 1 || !nearer) std::swap(chosen, frame);
  }
  if (frames == 0) fail_input(path, "holds no frame");
  if (asked.index && frames < *asked.index) {
    fail_input(path, fmt::format("there is no frame {}", *asked.index), fmt::format("expected 1 to {}", frames));
  }
  if (asked.time) check_time(path, *asked.time, first, last);
  std::optional<Scene> scene;
  if (asked.velocities || !asked.group.empty()) scene = scene_of(path, chosen);
  SceneFrame result = disks_of(chosen.disks, members_of(path, chosen, scene, asked.group));
  if (asked.velocities) {
    result.shear_rate = shear_rate_of(scene, chosen);
    result.brownian = scene && velocities_are_drawn(*scene);
    result.height = chosen.box.height;
  }
  return result;
}

}  // namespace carom
