// The events of a window one after the other, on one thread: for as many disks as its caches hold, the fastest way.
#pragma once

#include <cstdint>
#include <vector>

#include "core/impact_tally.hpp"
#include "parallel/exact_flight.hpp"
#include "parallel/exact_lists.hpp"
#include "parallel/exact_queue.hpp"
#include "parallel/exact_scan.hpp"
#include "parallel/exact_slice.hpp"
#include "parallel/executor.hpp"

namespace carom {

// Paths change where they stand, so there is nothing to claim, to join or to commit.
class ExactSequence {
 public:
  ExactSequence(ExactField& field, ExactLists& lists, const Executor& executor)
      : field_(field), lists_(lists), executor_(executor), scan_(field, lists) {}

  // Runs the window, about `expected` events. log: gets all paths, a disk's in order, if not null. Throws PhysicsError
  // at inelastic collapse.
  void run(std::size_t expected, double window_start, std::vector<LoggedPiece>* log);

  const ImpactTally& tally() const { return tally_; }  // of the window
  bool any_gone() const { return any_gone_; }

 private:
  // What goes with a Flight.
  struct Version {
    std::uint32_t own = 0;      // paths begun in the window
    std::uint32_t partner = 0;  // of the path that the partner was found on
  };

  void name(QueuedEvent& e) const;
  void process(const QueuedEvent& e);
  void process_pair(std::uint32_t i, const QueuedEvent& e);
  void look(std::uint32_t i, double from);
  void expect(std::uint32_t i, double time, std::uint32_t partner, DiskId id1, DiskId id2);
  double exit_after(std::uint32_t i, double from, double next) const;
  void list_anew(std::uint32_t i, double time);
  void meet_side(std::uint32_t i, double time);
  void meet_disk(std::uint32_t i, std::uint32_t j, double time);
  void begin_path(std::uint32_t i, const ExactDisk& now, bool gone);
  void count_burst(std::uint32_t i, double time, DiskId id1, DiskId id2);
  ExactDisk disk(std::uint32_t i) const;

  ExactField& field_;
  ExactLists& lists_;
  const Executor& executor_;
  ExactScan scan_;
  ExactQueue queue_;
  std::vector<Version> version_;
  ImpactTally tally_;
  std::vector<LoggedPiece>* log_ = nullptr;
  double window_start_ = 0.0;
  bool any_gone_ = false;
};

}  // namespace carom
