// The events of a slice in order of time: of all disks, or of a tile's disks as far as their motion is known.
#pragma once

#include <cstdint>

#include "parallel/exact/event_predictor.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"

namespace carom {

// A serial worker sees all disks, and nothing else changes any of them. A region's worker is given disks whose motion
// is known. No disk is faster than window.speed_bound, so that a disk whose motion is not yet known cannot touch disk i
// before its safe time, gap / (speed_bound + own speed) after the moment up to which it is known. Disk i is blocked
// at its safe time; up to then its path is right, whatever happens elsewhere.
class EventProcessor {
 public:
  EventProcessor(WindowState& window, NeighbourLists& lists, Worker& worker)
      : window_(window), lists_(lists), worker_(worker), predictor_(window, lists) {}

  // Queues the disk's next event, if it is within the slice.
  void push_next_event(std::uint32_t i) {
    if (window_.in_slice(window_.next_event_time[i])) worker_.queue.push({window_.next_event_time[i], 0, 0, i});
  }
  // Queues the safe time of the disk, whose motion is known up to `time`, if it is within the slice.
  void push_safe_time(std::uint32_t i, double time);
  // Processes all events of the queue; stops early where the worker's `ended` is set.
  void run();

 private:
  struct SafeTime {
    double time = never;
    std::uint32_t tile = serial_pass;  // what it waits for, as in BlockedDisk
    bool any = false;                  // is a neighbour unresolved?
  };

  void poll_watch();
  void name(QueuedEvent& e) const;
  void process(const QueuedEvent& e);
  void process_pair(std::uint32_t i, const QueuedEvent& e);
  bool is_resolved(std::uint32_t i) const { return worker_.is_serial || window_.progress[i].is_resolved(); }

  std::uint32_t blocking_tile(std::uint32_t i) const;
  double known_until(std::uint32_t unresolved) const;
  double safe_time_from(std::uint32_t i, double time, std::uint32_t unresolved) const;
  SafeTime safe_time(std::uint32_t i, double time) const;
  void reach_safe_time(std::uint32_t i, double time);
  void block(std::uint32_t i, double time, std::uint32_t tile);

  void predict_next_event(std::uint32_t i, double from);
  void schedule(std::uint32_t i, double time, Partner partner, DiskId id1, DiskId id2);
  double relist_time(std::uint32_t i, double from, double next) const;
  bool relist(std::uint32_t i, double time);
  void mark_relisted(std::uint32_t i);
  void mark_other_region(std::uint32_t i);
  std::uint16_t region_of(std::uint32_t i) const { return window_.region_of_tile[lists_.tile_of(i)]; }

  void meet_side(std::uint32_t i, double time);
  void collide_pair(std::uint32_t i, std::uint32_t j, double time);
  void begin_segment(std::uint32_t i, const ExactDisk& now, bool gone, const EventMark& event);
  void count_burst(std::uint32_t i, const EventMark& event);
  ExactDisk disk(std::uint32_t i) const;

  WindowState& window_;
  NeighbourLists& lists_;
  Worker& worker_;
  EventPredictor predictor_;
};

}  // namespace carom
