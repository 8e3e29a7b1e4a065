// A trajectory in memory.
#pragma once

#include <cstddef>
#include <vector>

#include "io/trajectory/trajectory_reader.hpp"

namespace carom::test {

// The frames outlive it.
class ReplayedTrajectory : public TrajectoryReader {
 public:
  explicit ReplayedTrajectory(const std::vector<TrajectoryFrame>& frames) : frames_(frames) {}
  bool read(TrajectoryFrame& frame) override {
    if (next_ == frames_.size()) return false;
    frame = frames_[next_++];
    return true;
  }

 private:
  const std::vector<TrajectoryFrame>& frames_;
  std::size_t next_ = 0;
};

}  // namespace carom::test
