// Processes the events of a slice that regions have left over, border by border: those of disks whose motion depends on
// other regions.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/exact/event_processor.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/region.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Between two successive regions is a border; the last region borders on the first one. The disks of a border are those
// from the middle of one region to the middle of the next, so that each disk belongs to one border. One thread
// processes the events of a border's disks. Borders are independent of each other, unless a disk whose motion is not
// known lists such a disk of another border: these borders are joined for the slice and have one thread. No disk is
// relisted before the slice's end, since none leaves its skin in a slice (SliceScheduler::longest_slice).
class BorderPass {
 public:
  BorderPass(WindowState& window, NeighbourLists& lists, const Executor& executor)
      : window_(window), lists_(lists), executor_(executor) {}

  // Lays out the borders of new regions.
  void lay_out(const std::vector<Region>& regions);
  void begin_window();

  // Processes the events of the slice that regions left over. per_disk: events per disk and unit of time, may be
  // approximate.
  void run(const std::vector<Region>& regions, double per_disk);
  // Has the pass found that the window is invalid?
  bool ended() const;

  // After the slice, on one thread: relists disk i if it has moved further than is allowed for a disk at a border at
  // the start of a slice.
  void relist_if_far(std::uint32_t i);

  // Disks that came to be at a border in the slice, and disks that now list one at a border.
  const std::vector<std::uint32_t>& new_border() const { return late_.border; }
  const std::vector<std::uint32_t>& new_near_border() const { return late_.near_border; }
  // Disks relisted in the slice.
  Count relisted() const;

  template <class Visit>
  void for_each_worker(Visit&& visit) const {
    for (const Border& border : borders_) visit(border.worker);
  }

 private:
  struct Border {
    Worker worker;
    ListRegion region;   // of its disks
    bool wraps = false;  // its disks are those outside `region`: this border lies between the last region and the first
    std::vector<std::uint32_t> disks;    // disks whose motion is not known
    std::vector<std::uint32_t> touches;  // other borders
    std::uint32_t leader = 0;  // the border that leads those joined with this one: its worker processes the events
    bool is_alone = true;
    bool holds(std::uint32_t disk) const { return region.holds(disk) != wraps; }
  };

  std::uint32_t border_of(std::uint32_t i) const { return border_of_tile_[lists_.tile_of(i)]; }
  void collect(std::uint32_t b, const std::vector<Region>& regions);
  void collect(Border& border, std::uint32_t i) const;
  bool lists_are_inside(const Border& border, std::uint32_t i) const;
  void join();
  std::uint32_t leader_of(std::uint32_t b) const;
  void process(std::uint32_t leader, double per_disk);
  void relist_late();

  WindowState& window_;
  NeighbourLists& lists_;
  const Executor& executor_;
  std::vector<Border> borders_;                // one behind each region
  std::vector<std::uint16_t> border_of_tile_;  // by tile
  Worker late_;                                // relists disks whose lists reach beyond their border
};

}  // namespace carom
