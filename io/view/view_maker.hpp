// Makes a page of limited size from a trajectory of any length.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/block_runner.hpp"
#include "io/trajectory/trajectory_reader.hpp"
#include "io/view/view_story.hpp"

namespace carom {

// Opens the trajectory at its first frame; may be called several times.
using OpenTrajectory = std::function<std::unique_ptr<TrajectoryReader>()>;

struct ViewWork {
  std::size_t most_bytes = 64'000'000;  // of the page
  std::size_t threads = 1;              // number of blocks to be packed at the same time
  BlockRunner run = run_in_order;
};

struct ViewMade {
  std::string page;
  std::vector<std::string> left_out;  // sentences, as they are on the page
  std::size_t frames = 0, disks = 0, disk_frames = 0;
  std::size_t packed_bytes = 0;  // of the frames, before they became text
};

// Reads the trajectory twice, and once more each time that it must leave out more: first frames, down to about a
// hundred, and then disks as well. Throws InputError if the trajectory is damaged or has no frame, and if not even a
// hundredth of its disks fits; name: of the trajectory, for the message.
ViewMade make_view(const OpenTrajectory& open, const std::string& name, ViewStory story, const ViewWork& work);

}  // namespace carom
