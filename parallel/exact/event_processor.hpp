// Processes the events of a slice in order of time: those of all disks, of a region's disks as far as their motion is
// known, or of the remaining ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/exact/event_predictor.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/plain_collision.hpp"
#include "parallel/exact/safe_times.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"

namespace carom {

// The disks whose events are processed. Only with regions are there disks whose motion is not known.
enum class Scope : std::uint8_t {
  all,   // all disks, in a single queue
  part,  // the disks of a thread's part of the box and its halo, in a single queue; events of the halo are not counted
  region,  // a region's disks, as far as their motion is known (SafeTimes), on a thread of its own
  border,  // disks at a border whose motion is not known, after all regions (BorderPass)
};

// What the collision of two disks needs in this scene: the first kind that applies.
enum class PairKind : std::uint8_t {
  elastic_of_one_mass,      // on straight paths, and nothing in the scene loses energy
  of_constant_restitution,  // the restitution of all contacts is the same number
  smooth,                   // no spins, no shear
  sheared,                  // no spins
  any,
};

// Is the restitution a number that is known in advance?
constexpr bool is_constant(PairKind kind) {
  return kind == PairKind::elastic_of_one_mass || kind == PairKind::of_constant_restitution;
}

// A disk's next event as it is scheduled.
struct ScheduledEvent {
  double time;
  Partner partner;
};

template <Scope scope>
class EventProcessor {
 public:
  EventProcessor(WindowState& window, NeighbourLists& lists, Worker& worker);

  // All and region: enters the disks into the calendar, which expects about this number of events a disk in the window.
  void enter_all(double events_a_disk);
  // Region: the disk, whose motion was not known, becomes active now.
  void enter(std::uint32_t i);
  // Region: computes the disk's safe time at the start of a slice (SafeTimes::push).
  void push_safe_time(std::uint32_t i) { safe_times_.push(i, window_.slice_start); }
  // Part: the disk, which belongs to the halo, changes to another path at the slice's end.
  void replace_path(std::uint32_t i);
  // Border: queues the disk's next event if it is within the slice.
  void push_next_event(std::uint32_t i);
  // Border, at the slice's end: relists those of the disks that are marked relists_late and whose lists are within the
  // worker's region, and predicts their next events.
  void relist_late(const std::vector<std::uint32_t>& disks);
  // Border, when the path at the slice's end is known: relists the disk if it has moved too far and has not left the
  // box.
  void relist_if_due(std::uint32_t i);
  // Border, after the slice, while no other thread works: relists disk i unless it is within the relist distance of
  // disks near a border, and sets the resulting marks for the next slice.
  void relist_if_far(std::uint32_t i);
  // Border: predicts the disk's next event, after the slice.
  void predict_next_slice(std::uint32_t i);
  // Border: sets the marks for the next slice that result from the disk's new list, while no other thread works.
  void mark_relisted(std::uint32_t i) { safe_times_.mark_relisted_at_border(i); }
  // Processes all events of the slice; stops early if the worker's `ended` is set.
  void run();

 private:
  // Functions that are called for nearly every event are marked gnu::hot, here and in the lists, so that they are
  // placed together: they fit in an instruction cache of 32 KB, but not if the linker scatters them.
  static constexpr bool has_regions = scope == Scope::region || scope == Scope::border;

  Count poll_watch();
  void name(QueuedEvent& e) const;
  [[gnu::hot]] void run_all();
  void run_region();
  void run_border();
  [[gnu::always_inline]] inline bool find_first(std::uint32_t& i, double& time);
  bool comes_first(std::uint32_t a, std::uint32_t b) const;
  [[gnu::always_inline]] inline void process(std::uint32_t i, double time);
  [[gnu::noinline, gnu::hot]] void process_other(std::uint32_t i, double time);
  [[gnu::always_inline]] inline void process_pair(std::uint32_t i, std::uint32_t j, double time);
  void process_border(const QueuedEvent& e);
  void predict_after_event(std::uint32_t i, double time);

  [[gnu::hot]] ScheduledEvent next_event(std::uint32_t i, double from, const NextEvent& next);
  // newest: as in EventPredictor::first_in. enters: the disk is not in the calendar.
  template <bool newest, bool enters = false>
  [[gnu::hot]] void predict_next_event(std::uint32_t i, double from);
  [[gnu::noinline, gnu::hot]] void schedule_no_contact(std::uint32_t i, double from);
  [[gnu::noinline, gnu::hot]] void predict_from_all(std::uint32_t i, double from);
  [[gnu::noinline, gnu::hot]] void schedule_next(std::uint32_t i, double from, const NextEvent& next);
  [[gnu::always_inline]] inline void schedule(std::uint32_t i, double time, Partner partner);
  [[gnu::hot]] void relist_and_predict(std::uint32_t i, double time);
  void put_off_relisting(std::uint32_t i);
  [[gnu::hot]] bool relist(std::uint32_t i, double time, const RelistDistance& ahead);
  bool relist_a_little(std::uint32_t i, double time);
  [[gnu::always_inline]] inline bool relist_at(std::uint32_t i, double time, Vec2 at);
  [[gnu::noinline]] void show_images_if_far(std::uint32_t i, double time);
  [[gnu::noinline]] void look_beyond_border(std::uint32_t i, Vec2 at);
  [[gnu::always_inline]] inline bool stays_listed(std::uint32_t i, double from, double until,
                                                  const RelistDistance& relist) const;
  bool stays_in_skin(std::uint32_t i, double time) const;
  void block(std::uint32_t i, double time);
  [[gnu::always_inline]] inline bool is_near_border(std::uint32_t i) const;
  const RelistDistance& relist_distance(std::uint32_t i) const { return lists_.relist_distance(is_near_border(i)); }
  // Do this rank's, or this part's, sums include the disk?
  bool counts(std::uint32_t i) const { return scope == Scope::all || !record_[i].progress.has(DiskProgress::ghost); }
  // A part counts only its own disks, so that all parts together see whether the window is crowded.
  Count segments_of(std::uint32_t i) const { return scope != Scope::part || counts(i) ? 1 : 0; }
  void note_contact(DiskRecord& a, DiskRecord& b);
  void note_listing(std::uint32_t i);
  void meet_side(std::uint32_t i, double time);
  void meet_obstacle(std::uint32_t i, double time);
  void take(std::uint32_t i, SinkNumber sink, double time);
  [[gnu::always_inline]] inline void collide_pair(std::uint32_t i, std::uint32_t j, double time);
  template <PairKind kind, class Flight>
  [[gnu::noinline]] void collide_smooth_pair(const Flight& flight, std::uint32_t i, std::uint32_t j, double time);
  template <PairKind kind>
  [[gnu::always_inline]] inline void tally_smooth_pair(std::uint32_t i, std::uint32_t j, const PlainCollision& outcome,
                                                       const PairRestitution& pair);
  [[gnu::always_inline]] inline void begin_paths(std::uint32_t i, std::uint32_t j, double fastest2,
                                                 const EventMark& event);
  PairRestitution pair_restitution(std::uint32_t i, std::uint32_t j, double time, const Relative& r) const;
  void collide_any_pair(std::uint32_t i, std::uint32_t j, double time);
  void tally_virials();
  template <bool falls, class RestitutionOf>
  [[gnu::noinline, gnu::cold]] PlainCollision collide_across(double time, Shares share, RestitutionOf restitution,
                                                             PathSegment& p, PathSegment& q) const;
  void log_start(std::uint32_t i);
  // partner: see LoggedSegment.
  void log_segment(std::uint32_t i, std::uint32_t partner, const PathSegment& path);
  void log_spin(std::uint32_t i, double now);
  void begin_segment(std::uint32_t i, const ExactDisk& now, std::uint32_t partner, const EventMark& event);
  void count_burst(std::uint32_t i, const EventMark& event);
  // Border: was the disk's motion known to the end of the slice before?
  bool is_over(std::uint32_t i) const { return scope == Scope::border && record_[i].progress.is_active(); }
  ExactDisk disk(std::uint32_t i) const;

  WindowState& window_;
  NeighbourLists& lists_;
  Worker& worker_;
  SafeTimes safe_times_;
  EventPredictor predictor_;
  DiskRecord* record_;
  PairKind pairs_;
  bool is_straight_;     // neither gravity nor a shear acts
  FreeFall fall_;        // with the scene's gravity
  double reduced_mass_;  // of two disks, if all have the same mass
  InnerPart inner_part_;
  // Virials of the last collisions of smooth disks, not yet tallied.
  std::array<double, 256> virials_{};
  std::array<double, 256> shear_virials_{};  // of the same collisions, in a sheared box
  std::size_t virial_count_ = 0;
};

}  // namespace carom
