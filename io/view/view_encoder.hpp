// Packs the frames of a trajectory for the browser as they come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/shear.hpp"
#include "io/trajectory/trajectory_reader.hpp"
#include "io/view/view_block.hpp"

namespace carom {

// All disks that any frame shows, in the order in which they first appear.
struct ViewDisks {
  std::vector<DiskId> id;
  std::vector<double> radius, mass;  // length, mass
  std::vector<DiskId> group;         // 0 if the trajectory does not have it
};

class ViewEncoder {
 public:
  // every: only disks whose id is a multiple of it are shown. at_once: the number of blocks that run distributes
  // together, equal to the number of threads. at_once and run change no byte. shear: of the box.
  ViewEncoder(const ViewAxes& axes, DiskId every, std::size_t at_once = 1, BlockRunner run = run_in_order,
              const Shear& shear = {});

  void add(const TrajectoryFrame& frame);

  // Packs the remaining frames. Before that, blocks() and packed_bytes() do not include the last frames.
  void finish();

  const ViewAxes& axes() const { return axes_; }
  const std::vector<ViewBlock>& blocks() const { return blocks_; }
  const ViewDisks& disks() const { return disks_; }
  const std::vector<double>& times() const { return times_; }
  // The end of a scale of speeds: 2.5 root mean squares of the displacement between two frames over their time, or the
  // fastest of these speeds, for up to a thousand disks a frame; 0 if no disk moved.
  double fast_speed() const;
  std::size_t disk_frames() const { return disk_frames_; }  // disks of all frames
  std::size_t packed_bytes() const { return packed_bytes_; }

 private:
  std::uint32_t place_of(const TrajectoryFrame& frame, std::size_t i);
  ViewFrame encoded(const TrajectoryFrame& frame);
  void add_to_block(ViewFrame&& view);
  void pack_waiting();
  void look_at_speeds(const ViewFrame& frame, double time);
  double offset_at(double time) const;  // of the images above; 0 if the box is not sheared

  ViewAxes axes_;
  DiskId every_;
  std::size_t at_once_;
  BlockRunner run_;
  Shear shear_;
  ViewDisks disks_;
  // The index in disks_ of each id. Used only for look-up: its order, which libraries choose, affects no byte.
  std::unordered_map<DiskId, std::uint32_t> places_;
  std::vector<double> times_;
  std::vector<std::vector<ViewFrame>> waiting_;  // frames of the next blocks; the last one grows
  std::size_t in_last_ = 0;                      // disks of all its frames
  std::vector<ViewBlock> blocks_;
  std::size_t disk_frames_ = 0, packed_frames_ = 0, packed_bytes_ = 0;  // packed_frames_: in blocks()
  ViewFrame sampled_;                                    // some disks of the last frame, for their speeds
  double squares_ = 0.0, fastest_ = 0.0, speeds_ = 0.0;  // of the speeds found: sum of squares, largest, number
};

}  // namespace carom
