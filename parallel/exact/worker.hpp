// The data of one thread in a window of the exact engine, and its results.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/physics/exact_event.hpp"
#include "core/physics/impact_tally.hpp"
#include "parallel/exact/event_calendar.hpp"
#include "parallel/exact/event_queue.hpp"
#include "parallel/exact/neighbour_lists.hpp"

namespace carom {

// A segment of a disk's path in the last window; frames and contacts are read from these.
struct LoggedSegment {
  // Values of partner for a segment that does not begin with a contact of disks: no_disk; gone, the disk left through a
  // sink.
  static constexpr std::uint32_t no_disk = 0xffffffffU;
  static constexpr std::uint32_t gone = 0xfffffffeU;

  std::uint32_t disk;
  std::uint32_t partner;  // the disk met at path.start, or one of these
  PathSegment path;

  bool with_disk() const { return partner < gone; }
};

// A disk whose motion is known only up to its safe time, because a neighbour's is not known.
struct BlockedDisk {
  std::uint32_t disk;
  double safe_time;
};

// The time at which a disk's safe time must be computed again.
struct SafeTimeDue {
  double time;
  std::uint32_t disk;
};

// Members refer to the window unless stated otherwise.
struct Worker {
  ListRegion region;                    // memory that it may read and write
  EventCalendar calendar;               // of a single queue, or of a region
  std::size_t number = 0;               // of the region
  std::vector<SafeTimeDue> safe_times;  // of a region: a heap, the first on top
  EventQueue queue;                     // of a border
  ImpactTally tally;
  std::vector<LoggedSegment> log;  // a disk's segments in order
  bool any_gone = false;
  double fastest2 = 0.0;              // largest v^2
  Count segments = 0;                 // begun
  std::optional<EventMark> collapse;  // the first one, except with regions
  // Each of these makes the window void. too_fast: a disk was faster than the speed bound, or one whose motion was
  // taken as known had to collide. crowded: there are too many events; this is the event at which that was noticed, the
  // first such event except with regions. given_up: Engine::set_watch said to stop.
  bool too_fast = false;
  std::optional<EventMark> crowded;
  bool given_up = false;
  bool ended = false;                      // one of these, or a collapse without regions: process no further event
  Count until_poll = 0;                    // events before go_on is asked again
  Count relisted = 0;                      // disks, in the slice
  std::vector<BlockedDisk> blocked;        // in the slice
  std::vector<std::uint32_t> marked;       // disks marked has_unresolved_neighbour in the slice
  std::vector<std::uint32_t> border;       // disks that came to be at a border in the slice
  std::vector<std::uint32_t> near_border;  // disks marked lists_border in the slice
  std::vector<std::uint32_t> late;         // disks marked relists_late in the slice, and relisted at its end
  FoundNeighbours found;                   // scratch
  std::vector<double> spin_log;            // of rough disks: the spin on each segment of `log`

  void begin_window() {
    tally = {};
    log.clear();
    spin_log.clear();
    any_gone = false;
    fastest2 = 0.0;
    segments = 0;
    collapse.reset();
    crowded.reset();
    too_fast = given_up = ended = false;
  }
  void begin_slice() {
    relisted = 0;
    safe_times.clear();
    blocked.clear();
    marked.clear();
    border.clear();
    near_border.clear();
    late.clear();
  }
};

}  // namespace carom
