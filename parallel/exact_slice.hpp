// A slice of a window: every event of a short time, solved in components by all threads.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "core/impact_tally.hpp"
#include "parallel/exact_lists.hpp"
#include "parallel/exact_loop.hpp"
#include "parallel/executor.hpp"

namespace carom {

// A segment of a disk's path in the last window; frames are read from these.
struct LoggedPiece {
  std::uint32_t disk;
  bool gone;  // left through a sink at path.start
  PathSegment path;
};

// The events of [slice_start, slice_end) happen in four phases:
//   1. look      every disk that is due grows a component of the disks that it meets       all blocks at once
//   2. cross     members of different components that are neighbours: do their paths meet?  all arenas at once
//   3. join      components that meet are solved again, together                            one thread; a few in 100
//   4. commit    the members' new paths become everybody's                                  all arenas at once
// In phases 1 to 3 the paths at the slice's start are only read, so a component is a function of its members. Which
// component a disk ends up in depends on the threads; its path does not: a component whose members meet nobody outside
// is the true motion of its members, whoever else is in it.
class ExactSlices {
 public:
  ExactSlices(ExactField& field, ExactLists& lists, const Executor& executor)
      : field_(field), lists_(lists), executor_(executor) {}

  // A window begins: log and tally are empty.
  void begin_window();

  // Runs the slice. False: a disk went too far for its list within it, nothing has happened; cut the slice short and
  // try again. Returns true when done. Throws PhysicsError at inelastic collapse.
  bool run(double start, double end, double window_start);

  // No log from now on.
  void forget_paths() { keeps_paths_ = false; }
  bool keeps_paths() const { return keeps_paths_; }

  ImpactTally tally() const;
  Count events() const;  // of the window so far
  bool any_gone() const { return any_gone_; }
  std::span<const std::vector<LoggedPiece>> log() const { return log_; }

 private:
  void list_leaving();
  void look();
  void cross();
  bool join();
  void commit();

  void cross_check(ExactArena& arena, std::size_t begin, std::vector<Conflict>& conflicts);
  double first_meeting(const Member& a, const std::vector<Piece>& pieces_a, const Member& b,
                       const std::vector<Piece>& pieces_b) const;
  bool solve_together(ExactLoop& solver, std::vector<std::uint32_t>& group);
  bool list_roamers(std::uint32_t component);
  bool list_once(std::uint32_t i);
  void list_anew(std::span<const std::uint32_t> which);
  void release(ExactArena& arena, Component& component, std::vector<std::uint32_t>& disks);
  void free_disk(std::uint32_t i);
  void release_all();
  void fail_if_collapsed(double window_start) const;
  void commit_arena(std::size_t a);
  void log_pieces(const ExactArena& arena, const Member& m, std::vector<LoggedPiece>& log) const;

  Component& component_of(std::uint32_t handle) {
    ExactArena& arena = arenas_[arena_of(handle)];
    return arena.components[arena.members[member_of(handle)].component];
  }
  ExactArena& joint() { return arenas_.back(); }

  ExactField& field_;
  ExactLists& lists_;
  const Executor& executor_;
  std::size_t block_ = 1;             // disks a block
  std::vector<ExactArena> arenas_;    // one a block, and one for what is joined
  std::vector<ImpactTally> tallies_;  // likewise
  std::vector<std::vector<LoggedPiece>> log_;
  bool keeps_paths_ = true;
  std::vector<unsigned char> gone_seen_;
  std::vector<double> fastest2_;
  std::vector<Vec2> places_;            // scratch
  std::vector<std::uint32_t> waiting_;  // disks to be solved again
  // Disks listed anew one by one in this slice. Only asked whether it holds a disk, never gone through, so its order
  // reaches no result.
  std::unordered_set<std::uint32_t> listed_anew_;
  bool any_gone_ = false;
};

}  // namespace carom
