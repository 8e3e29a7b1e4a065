// A run on several ranks as one program sees it: rank 0 has the engine that the program steps, looks at and saves, and
// the other ranks do what it does, each with its slab.
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

// Rank 0 of a program on several ranks. end() lets the others go; until then they wait for what it does.
class RankLead {
 public:
  // Precondition: ranks.rank() == 0; it outlives the lead.
  explicit RankLead(Ranks& ranks) : ranks_(ranks) {}

  int count() const { return ranks_.count(); }

  // The engine of all ranks, with the bits of one machine. start(state): what the other ranks make scene and state of,
  // by the function that they gave follow_lead; of a state without disks, as each is sent the disks in its slab.
  // state() has all disks, which costs a message from every rank in each step after which it is asked for; progress()
  // has those of rank 0. Throws InputError for the method rollback, whose frames are of the whole box. The lead
  // outlives the engine.
  std::unique_ptr<Engine> make_engine(const Scene& scene, State initial, const Threads& threads,
                                      const std::function<std::string(const State&)>& start);

  // The same of disks that come some at a time, from a checkpoint: no rank has all. initial: has none.
  std::unique_ptr<Engine> make_engine(const Scene& scene, State initial, std::unique_ptr<DiskSource> disks,
                                      const Threads& threads, const std::function<std::string(const State&)>& start);

  // The same of the scene's own start, which each rank makes for its slab: no rank has all disks. Null where the start
  // is not of a kind that can be made so, or is one that is refused: make_engine with the state of one machine is then
  // the way, or says why. start: is given a state without disks.
  std::unique_ptr<Engine> make_engine_at_start(const Scene& scene, const Threads& threads,
                                               const std::function<std::string(const State&)>& start);

  // Of the engine that was made last. Precondition: it is there, and no rank is lost.
  RankReport report() const { return report_(); }
  // Figures of all disks, with the bits of one machine; no rank needs to have them all.
  StateSums sums() const { return sums_(); }
  DeepestOverlaps overlaps() const { return overlaps_(); }

  // To be called once, when no engine is left. Does nothing after lost().
  void end();

  // Has a rank failed in the middle of what all ranks do? Then they can agree on nothing any more.
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

// Of the ranks above 0: follows the lead until it ends. read: what it was given for make_engine, read back.
void follow_lead(Ranks& ranks, const Threads& threads,
                 const std::function<std::pair<Scene, State>(const std::string& start)>& read);

}  // namespace carom
