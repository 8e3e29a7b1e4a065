// The events of a slice in order of time: of all disks, or of a tile's disks as far as their motion is known.
#pragma once

#include <cstdint>

#include "parallel/exact/event_predictor.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/safe_times.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"

namespace carom {

// A serial worker sees all disks, and nothing else changes any of them. A region's worker is given disks whose motion
// is known (SafeTimes).
//
// tiled: false for a single queue, whose worker sees all disks: an event calendar takes the place of the queue, and
// whatever has to do with unresolved disks is not there.
template <bool tiled>
class EventProcessor {
 public:
  EventProcessor(WindowState& window, NeighbourLists& lists, Worker& worker);

  // Single queue: enters all disks into the calendar, for about `expected` events in the window, and takes the times
  // of their next events out again.
  void enter_all(std::size_t expected);
  void leave_all();
  // Tiled: queues the disk's next event, if it is within the slice.
  void push_next_event(std::uint32_t i) {
    if (window_.in_slice(window_.next_event_time[i])) worker_.queue.push({window_.next_event_time[i], 0, 0, i});
  }
  // Tiled: queues the disk's safe time (SafeTimes::push).
  void push_safe_time(std::uint32_t i, double time) { safe_times_.push(i, time); }
  // Processes all events that are queued; stops early where the worker's `ended` is set.
  void run();

 private:
  void poll_watch();
  void name(QueuedEvent& e) const;
  void run_calendar();
  void run_queue();
  bool comes_first(std::uint32_t a, std::uint32_t b) const;
  void process(std::uint32_t i, double time);
  void process(const QueuedEvent& e);
  void process_pair(std::uint32_t i, const QueuedEvent& e);
  bool is_resolved(std::uint32_t i) const { return worker_.is_serial || window_.progress[i].is_resolved(); }

  // newest: as EventPredictor::earliest.
  template <bool newest>
  void predict_next_event(std::uint32_t i, double from);
  void schedule(std::uint32_t i, double time, Partner partner);
  bool relist(std::uint32_t i, double time);
  void meet_side(std::uint32_t i, double time);
  void collide_pair(std::uint32_t i, std::uint32_t j, double time);
  void collide_plain_pair(std::uint32_t i, std::uint32_t j, double time);
  void collide_any_pair(std::uint32_t i, std::uint32_t j, double time);
  void begin_plain_segment(std::uint32_t i, std::uint32_t partner, const PathSegment& path);
  void log_segment(std::uint32_t i, bool gone, const PathSegment& path);
  void begin_segment(std::uint32_t i, const ExactDisk& now, bool gone, const EventMark& event);
  void count_burst(std::uint32_t i, const EventMark& event);
  ExactDisk disk(std::uint32_t i) const;

  WindowState& window_;
  NeighbourLists& lists_;
  Worker& worker_;
  SafeTimes safe_times_;
  EventPredictor predictor_;
  DiskRecord* record_;
  bool is_plain_;
  double reduced_mass_;  // of two disks of a plain scene
};

}  // namespace carom
