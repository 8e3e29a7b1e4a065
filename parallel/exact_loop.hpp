// Events of a slice in order of time, for the disks of one block or for a group that has to be solved together.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/exact_arena.hpp"
#include "parallel/exact_lists.hpp"
#include "parallel/exact_scan.hpp"

namespace carom {

// Disk i is due at the first of: its next event, leaving its list's range, what a cross check found, the horizon.
void put_off(ExactField& field, std::uint32_t i, const NextEvent& next, double exit, double cross);

// Runs events into an arena. A disk becomes a member, claimed for this arena, when its first event happens; until then
// all see it on its path at the start of the slice. The claim comes before the look around on the new path: of two
// threads that change neighbouring disks at the same time, at least one sees the other's claim.
class ExactLoop {
 public:
  ExactLoop(ExactField& field, const ExactLists& lists, ExactArena& arena)
      : field_(field), lists_(lists), arena_(arena), heap_(heap_of_this_thread()), scan_(field, lists) {}

  // All events of disks [begin, end). One with a disk of another block happens if that disk can have none before and
  // nobody holds it; otherwise the component is in conflict, and frozen.
  void run_block(std::uint32_t begin, std::uint32_t end);

  // Solves from the slice's start what grows from these disks, none of which anybody holds; returns the component's
  // number. Not while other threads run.
  std::uint32_t solve(const std::vector<std::uint32_t>& disks);

 private:
  static std::vector<HeapEntry>& heap_of_this_thread();
  void run();
  void process(const HeapEntry& e);
  void process_pair(const HeapEntry& e);
  bool is_ready(const HeapEntry& e);
  bool take_in(std::uint32_t disk);
  void start_over();

  void push(std::uint32_t disk, std::uint32_t version, const NextEvent& event);
  void push_due(std::uint32_t disk);
  std::uint32_t version_of(std::uint32_t other);
  void look_again(std::uint32_t disk);
  void look_around(std::uint32_t member);
  double exit_after(std::uint32_t disk, const PathSegment& path, double from, double next) const;

  std::uint32_t hold(std::uint32_t disk);
  std::uint32_t add_member(std::uint32_t disk);
  Member fresh_member(std::uint32_t disk, std::uint32_t component) const;
  std::uint32_t unite(std::uint32_t a, std::uint32_t b);
  void conflict(std::uint32_t disk, std::uint32_t other);

  void meet_side(std::uint32_t member, const NextEvent& e);
  void meet_disk(std::uint32_t member, std::uint32_t other, const NextEvent& e);
  void begin_piece(std::uint32_t member, const NextEvent& e, bool counts, const Impact& outcome);

  // Is the owner a member that this loop runs? In a joint solution the members of earlier ones are not.
  bool is_at_hand(std::uint32_t owner) const {
    return owner != nobody && arena_of(owner) == arena_.number &&
           (!joint_ || arena_.members[member_of(owner)].component == component_);
  }
  Component& component_of(std::uint32_t member) { return arena_.components[arena_.members[member].component]; }

  ExactField& field_;
  const ExactLists& lists_;
  ExactArena& arena_;
  std::vector<HeapEntry>& heap_;  // scratch, which all blocks of a thread share
  ExactScan scan_;
  bool joint_ = false;
  std::uint32_t begin_ = 0, end_ = 0;  // the block
  std::uint32_t component_ = 0;        // of a joint solution
  NextEvent last_;                     // the last event that happened
};

}  // namespace carom
