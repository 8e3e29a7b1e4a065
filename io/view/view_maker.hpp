// A trajectory of any length, made into a page of limited size.
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

// Opens the trajectory at its first frame, each time it is called.
using OpenTrajectory = std::function<std::unique_ptr<TrajectoryReader>()>;

struct ViewWork {
  std::size_t most_bytes = 64'000'000;  // of the page
  std::size_t threads = 1;              // blocks to be packed at the same time
  BlockRunner run = run_in_order;
};

struct ViewMade {
  std::string page;
  std::vector<std::string> left_out;  // sentences, as the page has them
  std::size_t frames = 0, disks = 0, disk_frames = 0;
  std::size_t packed_bytes = 0;  // of the frames, before they became text
};

// Reads the trajectory twice, and again for each time that it must leave out more: every so many frames at first, down
// to a hundred, and then disks as well. Throws InputError where the trajectory is damaged or has no frame, and where
// not even a hundredth of its disks fits; name is the trajectory's, for the message.
ViewMade make_view(const OpenTrajectory& open, const std::string& name, ViewStory story, const ViewWork& work);

}  // namespace carom
