// A run on several ranks as one program: rank 0 has the engine that the program steps, analyses and saves, and the
// other ranks follow its calls, each with its slab.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/disks/disk_source.hpp"
#include "core/measure/state_sums.hpp"
#include "core/step/engine.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/rank_report.hpp"
#include "parallel/slabs/slab_start.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// Rank 0 of a program on several ranks. Until end() the other ranks wait for its calls.
class RankLead {
 public:
  // Precondition: ranks.rank() == 0. ranks outlives the lead.
  explicit RankLead(Ranks& ranks) : ranks_(ranks) {}

  int count() const { return ranks_.count(); }

  // The engine of all ranks, with the bits of one machine. start(state): a text from which the other ranks make scene
  // and state, by the function that they gave follow_lead; its state has no disks, since each rank is sent the disks in
  // its slab. state() has all disks, which costs a message from every rank after each step for which it is called;
  // progress() has those of rank 0. Throws InputError for the method rollback, whose frames are of the whole box. The
  // lead outlives the engine.
  std::unique_ptr<Engine> make_engine(const Scene& scene, State initial, const Threads& threads,
                                      const std::function<std::string(const State&)>& start);

  // The same for disks that come in pieces, from a checkpoint: no rank has all of them. initial: without disks.
  std::unique_ptr<Engine> make_engine(const Scene& scene, State initial, std::unique_ptr<DiskSource> disks,
                                      const Threads& threads, const std::function<std::string(const State&)>& start);

  // The same for the scene's own start, which each rank makes for its slab: no rank has all disks. Null if the start is
  // not of a suitable kind, or is refused: then make_engine with the state of one machine either works or says why not.
  // start: is called with a state without disks.
  std::unique_ptr<Engine> make_engine_at_start(const Scene& scene, const Threads& threads,
                                               const std::function<std::string(const State&)>& start);

  // The report of the engine that was made last. Preconditions: it still exists, and no rank is lost.
  RankReport report() const { return report_(); }
  // Sums and overlaps of all disks, with the bits of one machine; no rank needs to have all disks.
  StateSums sums() const { return sums_(); }
  DeepestOverlaps overlaps() const { return overlaps_(); }

  // Must be called once, when there is no engine any more. Does nothing after lost().
  void end();

  // Has a rank failed in the middle of a collective call? Then the ranks can no longer agree on anything.
  bool lost() const { return lost_; }
  void lose() { lost_ = true; }

 private:
  std::unique_ptr<Engine> make_parts(const Scene& scene, State initial, std::unique_ptr<DiskSource> disks,
                                     const SlabStart& slabs, const Threads& threads,
                                     const std::function<std::string(const State&)>& start);
  std::unique_ptr<Engine> lead_engine(const Scene& scene, std::unique_ptr<Engine> part, const Threads& threads);

  Ranks& ranks_;
  std::function<RankReport()> report_;
  std::function<StateSums()> sums_;
  std::function<DeepestOverlaps()> overlaps_;
  bool lost_ = false;
};

// For the ranks above 0: follows the lead until it ends. read: makes scene and state from make_engine's start text.
void follow_lead(Ranks& ranks, const Threads& threads,
                 const std::function<std::pair<Scene, State>(const std::string& start)>& read);

}  // namespace carom
