// The events of a slice in order of time: of all disks, or of those of a tile as far as they can be known.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/physics/impact_tally.hpp"
#include "parallel/exact/exact_flight.hpp"
#include "parallel/exact/exact_lists.hpp"
#include "parallel/exact/exact_queue.hpp"
#include "parallel/exact/exact_scan.hpp"

namespace carom {

// A segment of a disk's path in the last window; frames are read from these.
struct LoggedPiece {
  std::uint32_t disk;
  bool gone;  // left through a sink at path.start
  PathSegment path;
};

// A disk whose motion is known up to a time within the slice only, for want of the motion of disks of another tile.
struct Doubt {
  std::uint32_t disk;
  std::uint32_t root;  // the tile, or no_tile
  double until;
};
inline constexpr std::uint32_t no_tile = 0xffffffffU;

// What a thread works on, and what it finds out: of the window, where nothing else is said.
struct ExactPart {
  ListsPart lists;  // what it may touch
  bool alone = true;
  ExactQueue queue;
  ImpactTally tally;
  std::vector<LoggedPiece> log;  // a disk's pieces in order
  bool any_gone = false;
  double fastest2 = 0.0;              // largest v^2
  Count paths = 0;                    // begun
  std::optional<EventMark> collapse;  // without tiles, the first one
  // Nothing of the window counts: what was taken for granted proved wrong; it is too long (with the event that tells,
  // the first one if alone); it was given up.
  bool is_void = false;
  std::optional<EventMark> crowded;
  bool given_up = false;
  bool ended = false;               // one of these, or a collapse if alone: no further event
  Count until_look = 0;             // events before go_on is asked again
  Count listed = 0;                 // disks listed anew in the slice
  std::vector<std::uint32_t> edge;  // disks that came to list one of another region in the slice
  std::vector<Doubt> doubts;        // of the slice
  FoundDisks found;                 // scratch

  void begin_window();
};

// Paths change where they stand. Alone, it sees everybody, and nobody else changes anything. Otherwise it is given some
// disks whose motion is known, and it takes a disk into doubt at the time from which on something unknown may have
// reached it: a disk that waits, or that is in doubt itself. Nobody flies faster than field.bound, so that time is no
// earlier than gap / (bound + own speed) after the motion of the other became unknown; up to it all that is known of
// the disk is true, whatever happens elsewhere.
class ExactEvents {
 public:
  ExactEvents(ExactField& field, ExactLists& lists, ExactPart& part)
      : field_(field), lists_(lists), part_(part), scan_(field, lists) {}

  // Puts what the disk is due for in the slice into the queue.
  void push_due(std::uint32_t i) {
    if (field_.in_slice(field_.due[i])) part_.queue.push({field_.due[i], 0, 0, i});
  }
  // Takes the disk, known up to `time`, into doubt when its time comes.
  void watch(std::uint32_t i, double time);
  // Runs all events of the queue, up to a collapse if alone.
  void run();

 private:
  struct Deadline {
    double time = never;
    std::uint32_t root = no_tile;
    bool any = false;  // is there anybody unknown near?
  };

  void name(QueuedEvent& e) const;
  void process(const QueuedEvent& e);
  void process_pair(std::uint32_t i, const QueuedEvent& e);
  bool is_known(std::uint32_t i) const { return part_.alone || field_.is_known(i); }
  std::uint32_t root_of(std::uint32_t i) const;
  double reached_by(std::uint32_t i, double time, std::uint32_t unknown) const;
  Deadline deadline(std::uint32_t i, double time) const;
  void see_deadline(std::uint32_t i, double time);
  void doubt(std::uint32_t i, double time, std::uint32_t root);
  void look(std::uint32_t i, double from);
  void expect(std::uint32_t i, double time, std::uint32_t partner, DiskId id1, DiskId id2);
  double exit_after(std::uint32_t i, double from, double next) const;
  bool list_anew(std::uint32_t i, double time);
  void mark_listed(std::uint32_t i);
  void mark_edge(std::uint32_t i);
  std::uint16_t region_of(std::uint32_t i) const { return field_.region_of_tile[lists_.tile_of(i)]; }
  void meet_side(std::uint32_t i, double time);
  void meet_disk(std::uint32_t i, std::uint32_t j, double time);
  void begin_path(std::uint32_t i, const ExactDisk& now, bool gone, const EventMark& event);
  void count_burst(std::uint32_t i, const EventMark& event);
  void ask_to_go_on();
  ExactDisk disk(std::uint32_t i) const;

  ExactField& field_;
  ExactLists& lists_;
  ExactPart& part_;
  ExactScan scan_;
};

}  // namespace carom
