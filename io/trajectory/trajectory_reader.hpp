// Reading trajectories of any format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// One frame, with disks in order of id; radius and mass are always columns, and so is spin if disks are rough, but
// their moment of inertia is not known. Files have only size and periodic sides of the box; all other sides are walls
// here.
struct TrajectoryFrame {
  Disks disks;
  double time = 0.0;
  Domain box;
  std::vector<DiskId> group;  // of each disk (disk_group.hpp); empty if the file does not have it
  // How often each disk has gone round across the periodic sides since the file's first frame with it; may be empty,
  // too.
  std::vector<std::int32_t> image_x, image_y;
  // What the file has for disks, which a frame without any disk would not show otherwise.
  bool has_groups = false, has_images = false, has_spins = false;
};

// Is the frame of a run in this box, as far as files tell?
inline bool is_in_box(const TrajectoryFrame& frame, const Domain& box) {
  return frame.box.width == box.width && frame.box.height == box.height && frame.box.periodic_x() == box.periodic_x() &&
         frame.box.periodic_y() == box.periodic_y();
}

class TrajectoryReader {
 public:
  TrajectoryReader() = default;
  TrajectoryReader(const TrajectoryReader&) = delete;
  TrajectoryReader& operator=(const TrajectoryReader&) = delete;
  virtual ~TrajectoryReader() = default;

  // Reads the next frame; returns false after the last one. For a growing file it may be called again then. Throws
  // InputError, naming the file and its fault.
  virtual bool read(TrajectoryFrame& frame) = 0;

  // The same without the frame's disks, which are not read or checked.
  virtual bool skip() {
    TrajectoryFrame passed;
    return read(passed);
  }

  // Says where a growing file has been moved to.
  virtual void follow([[maybe_unused]] const std::string& path) {}
};

// Throws InputError if there is no file of this name, or if the system cannot tell: the name may be too long, or its
// links may form a loop.
void check_present(const std::string& name);

// The trajectory in a run's folder, trajectory.xyz or trajectory.h5; empty if there is none.
std::filesystem::path trajectory_in(const std::filesystem::path& folder);

// The format follows from the file's first bytes: HDF5 or text. growing: a run is, or was, writing it, and an
// incomplete frame at the end does not count. Throws InputError if the file cannot be read.
std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, bool growing = false);

}  // namespace carom
