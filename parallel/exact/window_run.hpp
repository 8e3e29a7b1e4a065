// The windows of the exact engine, one after the other: the paths of the disks in each, and what lasts from one to the
// next, neighbour lists and the times of next events.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/phase_times.hpp"
#include "core/disks/state.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/scene/scene.hpp"
#include "core/step/window_length.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/engine_mode.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/path_kernels.hpp"
#include "parallel/exact/slice_scheduler.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// What the next window can take over from the one before.
enum class Known : std::uint8_t {
  nothing,
  lists,            // neighbour lists and storage order
  lists_and_times,  // and the next events' times, on paths that go on
};

// The lists are rebuilt, and the disks sorted, when disks have been relisted so many times on average: by then
// neighbours in space are no longer neighbours in storage.
inline constexpr double relistings_a_disk = 8.0;
// They are also rebuilt where one queue has more than this times as many disks as skin and cells were chosen for, or as
// many times fewer.
inline constexpr double most_growth = 1.25;

// With regions: no disk may become faster in a window than this factor times the fastest one at its start. A window in
// which one does is run again with a larger factor, and at last without regions. With 1.15, 1.25 and 1.35, 21, 2 and 0
// of 100 windows of 50000 disks were in vain; a larger factor makes slices shorter.
inline constexpr double speed_margin = 1.35;
inline constexpr double margin_of_retry = 2.5;  // over that of the try before
inline constexpr int most_retries = 4;

// Throws the PhysicsError of a window that was void on each of most_retries + 1 runs.
[[noreturn]] void fail_speed_bound(const WindowPlan& plan);

class WindowRun {
 public:
  // All arguments outlive it. The state may change between windows.
  WindowRun(const Scene& scene, State& state, const Executor& executor, PhaseTimes& times);

  // On one of several ranks; largest_radius: of all disks. Outlives it.
  void set_ghosts(WindowGhosts* ghosts, double largest_radius);

  Known known() const { return known_; }
  // Nothing beyond this is valid any more.
  void forget(Known left) { known_ = std::min(known_, left); }

  // Nothing is valid any more, and all will be built anew. Where there are many disks, the memory that it takes is
  // given back now.
  void forget_lists();

  // One queue, between windows: can disks be taken out of what is known, and added if no radius is larger than those
  // that are listed?
  bool takes_changes() const;
  // The disks from this one on are new, at the end of the columns; they are listed, and predicted at the start of the
  // next window.
  void append_disks(std::size_t first);
  // Disk i of the last window is to go, and the last one takes its index. disks: the columns, which have it still.
  void remove_disk(std::size_t i, const Disks& disks);

  // Are the lists to be built anew for this window?
  bool lists_due(const WindowPlan& plan) const;
  // Relistings of a disk since the lists were built, on average.
  double relistings() const;
  // Sorts the disks and lists them. Times that were known stay so, those up to which the lists before were valid.
  // sorted: as in NeighbourLists::build.
  void build_lists(const WindowPlan& plan, const ListLayout& layout, const NeighbourLists::Sorted& sorted = {});

  // The disks are those of a thread's part and of its halo; after build_lists. own: the indices of its own, all of them
  // at the start of the next window. largest_radius: of all disks of the box. all: the state of all, from which paths
  // are loaded, and to which those of own disks are stored; disk i is at slots[i] of its columns. All outlive it.
  void set_part(const PartEnds& ends, const std::vector<std::uint32_t>& own, double largest_radius, State& all,
                const std::vector<std::uint32_t>& slots);
  void set_own(std::size_t own) { own_ = own; }
  // Of a part, between windows: its last disk is new in the state and the slots; at: where it is.
  void append_last_disk(Vec2 at);
  // Of a part, between windows: asks whether own disk i may come beyond an end. If it may and is no ghost of the part
  // there, the next slice ends with too_fast.
  void note_listing(std::uint32_t i);
  // Of a part, at a slice's end: these ghosts have got other paths. They are relisted if need be, and their events are
  // predicted anew.
  void replace_paths(const std::vector<std::uint32_t>& disks) { scheduler_.replace_paths(disks); }

  // Runs the window; speeds: of all disks of the run at its start, as many as `disks`. margin: over the largest speed.
  // Unless the outcome is `done`, nothing counts. Precondition: lists are known.
  SliceOutcome run(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks, double margin);

  // The same in steps, for a part: what comes before the first slice, and each slice, from `start` to `end` (`never`:
  // the window's end). Then finish_slices.
  void begin(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks, double margin);
  SliceOutcome run_slice(const WindowPlan& plan, std::size_t disks, double start, double end);
  void finish_slices() { known_ = known_at_end_; }

  // After a window that was done: the disks are where it ends, and what they go on with is known. Where disks left
  // through sinks, gone has an entry for each disk, 1 for those, which stay in the columns; else it is empty. The sums
  // are those of the window.
  ImpactTally store_paths(const WindowPlan& plan, std::vector<unsigned char>& gone);

  void release_memory();

  // Of the last window.
  double length() const { return length_; }
  double largest_radius() const { return largest_radius_; }
  WindowState& window() { return window_; }
  const WindowState& window() const { return window_; }
  NeighbourLists& lists() { return lists_; }
  const NeighbourLists& lists() const { return lists_; }
  SliceScheduler& scheduler() { return scheduler_; }
  const SliceScheduler& scheduler() const { return scheduler_; }

 private:
  void count_window(const WindowPlan& plan);
  void load_paths(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks);
  void load_disks(std::size_t begin, std::size_t end, const WindowPlan& plan);
  void load_records(std::size_t begin, std::size_t end);
  void load_times(std::size_t begin, std::size_t end, const WindowPlan& plan);
  void predict_far_ones(std::size_t begin, std::size_t end, double safe_before2);
  double early_by() const;
  unsigned bits_of_new_sides(double start) const;
  void mark_disks();
  ImpactTally store_part(const WindowPlan& plan);
  ImpactTally end_window(const WindowPlan& plan, const std::vector<ImpactTally>& crossings);
  void sort_times(const std::vector<std::uint32_t>& order, std::vector<double>& scratch);
  bool are_outgrown() const;
  double first_relist_time(std::size_t i, const WindowPlan& plan) const;
  void store_straight(std::size_t begin, std::size_t end, double length);
  void set_speed_bound(const WindowPlan& plan, double margin);

  // Disks a block in passes over all disks.
  static constexpr std::size_t pass_block = 8192;

  const Scene& scene_;
  State& state_;
  State* all_;  // has the paths, last contacts and thermal hits of all disks: it is state_, except for a part
  const std::vector<std::uint32_t>* slots_ = nullptr;  // of a part
  const Executor& executor_;
  PhaseTimes& times_;
  WindowState window_;
  NeighbourLists lists_;
  SliceScheduler scheduler_;
  const PathKernels path_kernels_ = choose_path_kernels();
  WindowGhosts* ghosts_ = nullptr;
  double least_largest_radius_ = 0.0;  // of other ranks' or parts' disks
  double largest_radius_ = 0.0;
  Known known_ = Known::nothing;
  bool rebuilt_ = false;  // the lists, for the coming window
  // Then, if times stayed: up to which time of the run no other event of a disk comes before the one that is known.
  double known_until_ = never;
  double length_ = 0.0;                                    // of the last window
  double meant_ = 0.0;                                     // likewise; WindowState::meant
  int short_windows_ = 0;                                  // since all disks were predicted anew
  double longest_ = 0.0;                                   // window meant since then; time
  double per_disk_ = 0.0;                                  // events a disk and time, of the last slice
  const std::vector<std::uint32_t>* own_disks_ = nullptr;  // of a part, when its lists have been built
  std::size_t own_ = 0;                                    // of a part: disks that are not of its halo
  Known known_at_end_ = Known::nothing;
  std::size_t disks_when_built_ = 0;
};

}  // namespace carom
