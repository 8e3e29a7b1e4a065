// The windows of the exact engine on several threads, or of many disks: the box is cut into parts, each with a halo.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/phase_times.hpp"
#include "core/disks/disk_contact.hpp"
#include "core/disks/state.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/scene/scene.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/box_cut.hpp"
#include "parallel/exact/halo_part.hpp"
#include "parallel/exact/halo_tuning.hpp"
#include "parallel/exact/window_run.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Every part runs a slice of the window by itself. Then its ghosts are compared with the same disks in their owners,
// and take their paths. The own disks of all parts together are the system if in each slice
// - a ghost that an own disk met moved as in its owner, and so did a ghost that came beyond its owner's end,
// - no disk came beyond an end of its part into another part that does not have it as a ghost, or into a third part
// (PartEnds).
// Then every collision of an own disk is with a disk that is where the part has it, and no two disks of two parts
// overlap, since one of them would have come beyond the end, and the other's part would have had it at its true place.
// Otherwise the window is void. The bits depend neither on parts nor on halos.
class HaloWindows {
 public:
  // All arguments outlive it; the state may change between windows.
  HaloWindows(const Scene& scene, State& state, const Executor& executor, PhaseTimes& times);

  // Is the next window to be run in parts? Must be called once before each window.
  bool are_wanted();

  // From now on only this may still be valid.
  void forget(Known left);
  void release_memory();
  // Lists built from now on allow each radius to grow by this; length.
  void set_growth(double growth) { growth_ = growth; }

  // As WindowRun::run; builds lists if they are due. If the outcome is neither `done` nor `given_up`, the window has to
  // be run without parts. Of `window` only keeps_paths and go_on are used.
  SliceOutcome run(const WindowPlan& plan, const SpeedSummary& speeds, const WindowState& window);
  // After a window that was done: as WindowRun::store_paths; no disk has left the box.
  ImpactTally store_paths(const WindowPlan& plan);

  // Between windows, if everything has been known since the last one was done: these disks have new velocities.
  void change_velocities(std::span<const std::uint32_t> disks);
  // All radii have grown, by no more than growth() since the lists were built; the times of next events become invalid.
  void take_radii();
  // The growth of radii that the present lists allow for (NeighbourLists::growth).
  double growth() const;
  // Brings the lists up to date. Returns true if visit_lists then visits for each disk all disks against which it may
  // grow.
  bool complete_lists();
  // Calls visit(disk, near) for each disk, on all threads. near: the disks in its list.
  void visit_lists(const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const;
  // As Engine::visit_near.
  void visit_near(Vec2 centre, double half_width, double half_height,
                  const std::function<void(std::size_t)>& visit) const;
  Known known() const { return known_; }

  // Of the last window: moves the disks to time s of it, with their velocities then; its collisions; the largest speed
  // of a path in it (Engine::fastest_within).
  void move_along_paths(double s, Disks& disks) const;
  std::vector<DiskContact> contacts(double start) const;
  double fastest_within() const;

  // The number of parts in the last window.
  std::size_t parts() const { return parts_.size(); }
  // For measurements: how often a window was void and was run again.
  Count void_runs() const { return void_runs_; }

 private:
  bool work_is_cut() const;
  double mean_spacing() const;
  enum class Cuts : std::uint8_t { along_both_axes, along_longer_side };
  PieceCounts pieces(Cuts cuts) const;
  PieceCounts pieces_of(std::size_t parts, Cuts cuts) const;
  bool lists_due(const WindowPlan& plan) const;
  void build(const WindowPlan& plan);
  std::vector<DisksOfPart> share_out();
  void build_parts(const WindowPlan& plan, const BoxCut& cut, std::vector<DisksOfPart>&& disks);
  void add_work();
  void exchange_disks();
  void begin(const WindowPlan& plan, const SpeedSummary& speeds, const WindowState& window);
  SliceOutcome run_slices(const WindowPlan& plan);
  SliceOutcome run_slice(const WindowPlan& plan, double start, double end);
  bool is_crowded() const;
  template <class Task>
  void for_parts(Task&& task) const {
    executor_.run(parts_.size(), [&](std::size_t r) { task(*parts_[r]); });
  }

  const Scene& scene_;
  State& state_;
  const Executor& executor_;
  PhaseTimes& times_;
  HaloParts parts_;
  int pause_;  // windows to run without parts after one that could not be run in parts
  HaloTuning tuning_;
  PartWork work_;         // of the last parts, with their cut
  HaloUse use_;           // of the present window so far
  double spacing_ = 0.0;  // mean distance of disks; length
  double growth_ = 0.0;
  Known known_ = Known::nothing;
  int windows_without_ = 0;  // the number still to come
  Count void_runs_ = 0;
};

}  // namespace carom
