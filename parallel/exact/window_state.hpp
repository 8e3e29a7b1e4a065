// What the exact engine holds of every disk during a window, and the numbers that all disks share.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/physics/exact_event.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/engine_mode.hpp"

namespace carom {

// How far a disk's motion is known in the present slice: up to its end; as far as events have been processed; up to
// its start; up to a safe time within it, until the motion of the disk that blocks it is known.
enum class Progress : std::uint8_t { done, active, pending, blocked };

// A disk's progress in 32 bits; where it is blocked, also the number of its BlockedDisk (event_processor.hpp).
class DiskProgress {
 public:
  constexpr DiskProgress() = default;  // pending
  static constexpr DiskProgress done() { return DiskProgress(done_bits); }
  static constexpr DiskProgress active() { return DiskProgress(active_bits); }
  static constexpr DiskProgress pending() { return {}; }
  static constexpr DiskProgress blocked(std::uint32_t record) { return DiskProgress(record); }

  constexpr bool is(Progress progress) const { return state() == progress; }
  constexpr Progress state() const {
    return bits_ == active_bits    ? Progress::active
           : bits_ == done_bits    ? Progress::done
           : bits_ == pending_bits ? Progress::pending
                                   : Progress::blocked;
  }
  // Done or active: nothing that is still unknown can change the disk's path before the present event.
  constexpr bool is_resolved() const { return bits_ >= active_bits; }
  // Of a blocked disk.
  constexpr std::uint32_t record() const { return bits_; }
  // Done, if it is active; else as it is.
  constexpr DiskProgress finished() const { return DiskProgress(bits_ == active_bits ? done_bits : bits_); }

 private:
  static constexpr std::uint32_t pending_bits = 0xfffffffdU;
  static constexpr std::uint32_t active_bits = 0xfffffffeU;
  static constexpr std::uint32_t done_bits = 0xffffffffU;
  explicit constexpr DiskProgress(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = pending_bits;
};
static_assert(DiskProgress::active().is_resolved() && DiskProgress::done().is_resolved());
static_assert(!DiskProgress::pending().is_resolved() && !DiskProgress::blocked(0).is_resolved());
static_assert(DiskProgress::active().finished().is(Progress::done));
static_assert(DiskProgress::blocked(7).finished().is(Progress::blocked));

// Bits of WindowState::mark.
inline constexpr std::uint8_t lists_other_region = 1;
inline constexpr std::uint8_t lists_later_tile = 2;          // or a disk that lists_other_region
inline constexpr std::uint8_t has_unresolved_neighbour = 4;  // perhaps: one was pending or blocked in this slice

// Columns are by storage index.
struct WindowState {
  EngineMode mode = EngineMode::single_queue;
  ExactRules rules;
  const Disks* disks = nullptr;  // masses
  std::vector<DiskRecord> record;
  // No event that is stored with this disk happens before. An event of two disks is stored with the one that began its
  // path last (or with both), contact with a side and relisting with the disk itself.
  std::vector<double> next_event_time;
  std::vector<double> last_contact;  // with the TC model
  std::vector<Burst> burst;          // where any contact dissipates
  // Tiled mode only.
  std::vector<DiskProgress> progress;
  std::vector<std::uint8_t> mark;
  std::vector<std::uint16_t> region_of_tile;

  double length = 0.0;      // of the window; time
  double horizon = 0.0;     // events are predicted up to here, beyond the window
  double next_start = 0.0;  // just beyond the window
  double slack = 0.0;       // rounding of a coordinate, generously; length
  // Two disks (or a disk and a side) that are so close and approach each other so slowly may touch or not, and approach
  // or not, by the rounding at each window's start.
  double close = 0.0;  // length
  double slow = 0.0;   // length / time
  double largest_radius = 0.0;
  // The same for disks of any radii: squares of distance^2 - contact_distance^2 and of dr.dv.
  double close2() const { return 16.0 * largest_radius * largest_radius * (close * close); }
  double slow2() const { return 4.0 * largest_radius * largest_radius * (slow * slow); }
  // Up to this v^2 no disk moves so far in a window that images beyond the nearest one, or crossing events, matter.
  double safe_speed2 = 0.0;
  double fastest2 = 0.0;  // largest v^2 so far
  // Tiled mode: a segment that begins with more than speed_limit2 (v^2) voids the window, so that no disk is faster
  // than speed_bound, gravity included.
  double speed_limit2 = 0.0;
  double speed_bound = 0.0;
  double slice_start = 0.0;
  double slice_end = 0.0;  // events before this time; in the last slice up to and including `length`
  bool keeps_paths = true;
  Count most_paths = 0;         // of all disks, beyond which the window is crowded (core/step/window_length.hpp)
  std::function<bool()> go_on;  // as in Engine::set_watch

  bool in_slice(double t) const { return t < slice_end && t <= length; }
  double slice_stop() const { return slice_end < length ? slice_end : length; }
  bool is_done(std::uint32_t i) const { return mode == EngineMode::tiled && progress[i].is(Progress::done); }

  // The numbers of a window; fastest2 (v^2) and largest_radius are those of the disks. Columns get room for all disks.
  void begin(const ExactRules& window_rules, const Disks& all, const WindowPlan& plan, double fastest_speed2,
             double radius);
  void release_memory();

 private:
  void set_tolerances();
};

}  // namespace carom
