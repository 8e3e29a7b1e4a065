// The windows of the exact engine, one after the other: the paths of the disks in each, and what lasts from one window
// to the next: neighbour lists and the times of next events.
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

// What the next window can take over from the last one.
enum class Known : std::uint8_t {
  nothing,
  lists,            // neighbour lists and storage order
  lists_and_times,  // also the times of next events, on paths that go on
};

// The lists are rebuilt, and the disks sorted, when disks have been relisted this many times on average: by then
// neighbours in space are no longer neighbours in storage.
inline constexpr double relistings_a_disk = 8.0;
// They are also rebuilt if one queue has more disks than this times the number for which skin and cells were chosen, or
// fewer than that number over this.
inline constexpr double most_growth = 1.25;

// With regions: the largest speed of any disk in a window, over that of the fastest one at its start. If a disk becomes
// faster, the window is run again with a larger factor, and at last without regions. With 1.15, 1.25 and 1.35, 21, 2
// and 0 of 100 windows of 50000 disks were in vain; a larger factor makes slices shorter.
inline constexpr double speed_margin = 1.35;
inline constexpr double margin_of_retry = 2.5;  // factor between the margins of two successive runs
inline constexpr int most_retries = 4;

// Throws the PhysicsError of a window that was void on each of most_retries + 1 runs.
[[noreturn]] void fail_speed_bound(const WindowPlan& plan);

class WindowRun {
 public:
  // All arguments outlive it. The state may change between windows.
  WindowRun(const Scene& scene, State& state, const Executor& executor, PhaseTimes& times);

  // For one of several ranks. largest_radius: of the disks of all ranks. The ghosts outlive the WindowRun.
  void set_ghosts(WindowGhosts* ghosts, double largest_radius);

  Known known() const { return known_; }
  // From now on nothing beyond this is valid.
  void forget(Known left) { known_ = std::min(known_, left); }

  // From now on nothing is valid, and all will be built anew. If there are many disks, the memory for it is freed now.
  void forget_lists();

  // Between windows: can disks be removed without new lists, and added if none is larger than those listed? Only with
  // one queue.
  bool takes_changes() const;
  // Disks from this index on, at the end of the columns, are new: they are listed, and predicted at the start of the
  // next window.
  void append_disks(std::size_t first);
  // Disk i of the last window is removed, and the last one takes its index. disks: the columns, which still hold it.
  void remove_disk(std::size_t i, const Disks& disks);

  // Must the lists be built anew for this window?
  bool lists_due(const WindowPlan& plan) const;
  // The mean number of relistings of a disk since the lists were built.
  double relistings() const;
  // Sorts the disks and lists them. Known times stay known, up to the time to which the former lists were valid.
  // sorted: as in NeighbourLists::build.
  void build_lists(const WindowPlan& plan, const ListLayout& layout, const NeighbourLists::Sorted& sorted = {});

  // After build_lists: the disks are those of a thread's part and its halo. own: the indices of its own disks, which
  // are complete at the start of the next window. largest_radius: of all disks of the box. all: the state of all disks,
  // from which paths are loaded, and to which those of own disks are stored; disk i is at slots[i] of its columns. All
  // of these outlive the WindowRun.
  void set_part(const PartEnds& ends, const std::vector<std::uint32_t>& own, double largest_radius, State& all,
                const std::vector<std::uint32_t>& slots);
  void set_own(std::size_t own) { own_ = own; }
  // For a part, between windows: the last disk of the state and of the slots is new. at: its position.
  void append_last_disk(Vec2 at);
  // For a part, between windows: checks whether own disk i may come beyond an end. If it may and is not a ghost of the
  // part there, the next slice ends with too_fast.
  void note_listing(std::uint32_t i);
  // For a part, at a slice's end: these ghosts have new paths. They are relisted if necessary, and their events are
  // predicted anew.
  void replace_paths(const std::vector<std::uint32_t>& disks) { scheduler_.replace_paths(disks); }

  // Runs the window. speeds: of all disks of the run at its start. disks: their number. margin: the largest speed
  // allowed, over the largest at the start. Unless the outcome is `done`, the window has no effect. Precondition: lists
  // are known.
  SliceOutcome run(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks, double margin);

  // The same in steps, for a part: begin does what comes before the first slice, and run_slice runs a slice from
  // `start` to `end` (`never`: the window's end). Then finish_slices.
  void begin(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks, double margin);
  SliceOutcome run_slice(const WindowPlan& plan, std::size_t disks, double start, double end);
  void finish_slices() { known_ = known_at_end_; }

  // After a window that was done: moves the disks to its end, and keeps what is known for the next one. If disks left
  // through sinks, gone has an entry for each disk, 1 for these, which stay in the columns; otherwise it is empty.
  // Returns the sums of the window.
  ImpactTally store_paths(const WindowPlan& plan, std::vector<unsigned char>& gone);

  void release_memory();

  // The length of the last window.
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

  // Disks in a block, in passes over all disks.
  static constexpr std::size_t pass_block = 8192;

  const Scene& scene_;
  State& state_;
  State* all_;  // the state with the paths, last contacts and thermal hits of all disks: state_, except for a part
  const std::vector<std::uint32_t>* slots_ = nullptr;  // for a part
  const Executor& executor_;
  PhaseTimes& times_;
  WindowState window_;
  NeighbourLists lists_;
  SliceScheduler scheduler_;
  const PathKernels path_kernels_ = choose_path_kernels();
  WindowGhosts* ghosts_ = nullptr;
  double least_largest_radius_ = 0.0;  // of the disks of other ranks or parts
  double largest_radius_ = 0.0;
  Known known_ = Known::nothing;
  bool rebuilt_ = false;  // have lists been built for the coming window?
  // If rebuilt_ and times are known: the time of the run up to which no disk has an event before its known one.
  double known_until_ = never;
  double length_ = 0.0;                                    // of the last window
  double meant_ = 0.0;                                     // WindowState::meant of the last window
  int short_windows_ = 0;                                  // number since all disks were predicted anew
  double longest_ = 0.0;                                   // longest length meant since then; time
  double per_disk_ = 0.0;                                  // events per disk and time in the last slice
  const std::vector<std::uint32_t>* own_disks_ = nullptr;  // for a part whose lists have just been built
  std::size_t own_ = 0;                                    // for a part: number of its own disks
  Known known_at_end_ = Known::nothing;
  std::size_t disks_when_built_ = 0;
};

}  // namespace carom
