// The events of a slice of a window, distributed among regions and threads.
#pragma once

#include <cstdint>
#include <vector>

#include "core/physics/impact_tally.hpp"
#include "parallel/exact/border_pass.hpp"
#include "parallel/exact/border_watch.hpp"
#include "parallel/exact/event_processor.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/region.hpp"
#include "parallel/exact/slice_outcome.hpp"
#include "parallel/exact/window_ghosts.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// With a single queue, a window is one slice, and one worker processes its events. With regions, each thread has a
// region, a run of layers, and processes the events of its disks as far as they do not depend on disks whose motion is
// not known yet. A disk that lists one of another region is at the border; its motion in a slice becomes known in the
// border pass, after all regions. So does the motion of disks that are blocked because of such a disk. Which worker
// processes an event depends on the number of threads, but the event does not. On one of several ranks there is one
// region, and disks near the edge of the rank's known band are at a border; ghosts whose motion depends on disks that
// the rank does not have get their paths from other ranks.
class SliceScheduler {
 public:
  SliceScheduler(WindowState& window, NeighbourLists& lists, const Executor& executor)
      : window_(window), lists_(lists), executor_(executor), border_pass_(window, lists, executor) {}

  // Begins a window. Preconditions: window.mode and window.speed_bound have been set. rebuilt: the lists have been
  // built anew. per_disk: events per disk and unit of time, 0 if not known.
  void begin_window(bool rebuilt, double per_disk);

  // The end of the slice that begins at time `start` of a window of this length; `never` for the last slice. Slices are
  // of nearly equal length. per_disk and preconditions as for begin_window.
  double slice_end(double length, double start, double per_disk) const;

  // Runs a slice; it is the window's first one if start is 0. per_disk: as for begin_window, may be approximate.
  // window_start: time of the run. At inelastic collapse the outcome is `crowded` with regions and for a part; with a
  // single queue PhysicsError is thrown.
  SliceOutcome run(double start, double end, double per_disk, double window_start);
  // With a single queue: the event at which the window proved to be crowded, the same as in the reference.
  const EventMark& crowding() const { return *single_.crowded; }

  // For a part, at the end of a slice: as WindowRun::replace_paths.
  void replace_paths(const std::vector<std::uint32_t>& disks);

  // For the window so far.
  ImpactTally tally() const;
  Count events() const;
  bool any_gone() const;
  // Calls read(segments, spins) for each worker; spins is empty for smooth disks.
  template <class Read>
  void read_logs(Read&& read) const {
    for_each_worker([&](const Worker& worker) { read(worker.log, worker.spin_log); });
  }
  // Between windows: frees the memory of the calendars.
  void release_calendars();
  // With regions: watch is called at the end of each slice, before blocked disks continue.
  void set_border_watch(const BorderWatch& watch) { watch_ = watch; }
  // For one of several ranks; the ghosts outlive the scheduler.
  void set_ghosts(WindowGhosts* ghosts) { ghosts_ = ghosts; }
  // Events of the last slice, on all ranks.
  Count events_of_slice() const { return events_of_slice_; }
  // Paths begun in the window; for a part, by its own disks.
  Count segments() const;
  // Disks relisted since the lists were built.
  Count relisted() const { return relisted_; }

 private:
  template <class Visit>
  void for_each_worker(Visit&& visit) const {
    for (const Region& region : regions_) visit(region.worker);
    border_pass_.for_each_worker(visit);
    visit(others_);
    visit(single_);
  }
  double longest_slice() const;
  bool has_regions() const { return window_.mode == EngineMode::regions; }
  void lay_out_regions();
  void set_core_of_rank(ListRegion& region) const;
  void find_border(Region& region);
  void find_near_border(Region& region);
  void run_single_queue(double per_disk);
  void run_regions(double per_disk);
  void run_region(Region& region, double per_disk);
  void begin_slice(Region& region);
  void finish_slice(Region& region);
  void take_in_new_border(const std::vector<std::uint32_t>& border, const std::vector<std::uint32_t>& near_border);
  void take_in_border(std::uint32_t i);
  void take_in_near_border(std::uint32_t i);
  void mark_ghosts();
  void mark_edges();
  SliceOutcome run_with_ghosts(double per_disk);
  void see_slice_of_others();
  bool depends_on_others() const;
  void show_borders() const;
  Region& region_of(std::uint32_t i) { return regions_[window_.region_of_tile[lists_.tile_of(i)]]; }
  SliceOutcome outcome() const;

  WindowState& window_;
  NeighbourLists& lists_;
  const Executor& executor_;
  std::vector<Region> regions_;
  BorderPass border_pass_;  // with regions
  Worker single_;           // with a single queue: all disks
  Count relisted_ = 0;
  BorderWatch watch_;
  double slice_room_ = 0.0;  // most that a disk may fly in a slice; length
  Count events_of_slice_ = 0;
  WindowGhosts* ghosts_ = nullptr;
  Worker others_;  // for ghosts whose paths come from other ranks
  std::vector<std::uint32_t> unknown_;
};

}  // namespace carom
