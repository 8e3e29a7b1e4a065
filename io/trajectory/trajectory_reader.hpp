// Reading trajectories back, whatever their format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// One frame as read back, disks in order of id; radius and mass always come as columns, spin where disks are rough, of
// which the moment of inertia is not known. Of the box, files have size and periodic sides; all others appear as walls.
struct TrajectoryFrame {
  Disks disks;
  double time = 0.0;
  Domain box;
  std::vector<DiskId> group;  // of each disk (disk_group.hpp); empty where the file does not have it
  // How often each has gone round across the periodic sides, since the file's first frame that shows it; likewise.
  std::vector<std::int32_t> image_x, image_y;
  // What the file has of disks: a frame without any shows it nowhere else.
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

  // The next frame, or false after the last. Of a growing file, it may be asked for again. Throws InputError, naming
  // the file and what is wrong with it.
  virtual bool read(TrajectoryFrame& frame) = 0;

  // Likewise, but passes over it: its disks are not looked at, nor what may be wrong with them.
  virtual bool skip() {
    TrajectoryFrame passed;
    return read(passed);
  }

  // Where a growing file has been moved to.
  virtual void follow([[maybe_unused]] const std::string& path) {}
};

// Throws InputError where there is nothing of this name, or the system does not say: it may be too long, or go round in
// links.
void check_present(const std::string& name);

// The trajectory of a run's folder, trajectory.xyz or trajectory.h5; empty if there is none.
std::filesystem::path trajectory_in(const std::filesystem::path& folder);

// By what the file begins with: HDF5 or text. growing: a run is, or was, writing it, and what it began is no frame yet.
// Throws InputError if it cannot be read.
std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, bool growing = false);

}  // namespace carom
