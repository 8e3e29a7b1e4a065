// What each rank has of the engine that rank 0 leads (leading_engine.hpp), and what rank 0 can ask of all of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/measure/state_sums.hpp"
#include "core/step/engine.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/rank_report.hpp"
#include "parallel/slabs/shared_lists.hpp"
#include "parallel/slabs/shown_disks.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// What rank 0 says that comes next: which function of the lead, or of its engine, was called there.
enum class RankCall : std::int64_t {
  end,       // RankLead::end
  make,      // make_engine
  begin,     // make_engine_at_start
  step,      // Engine::step
  collect,   // state
  lists,     // pieces
  piece,     // a piece of a list of those
  show,      // pieces_at
  some,      // of these disks: DisksInPieces::visit
  overlap,   // max_overlap
  pairs,     // pair_counts
  orders,    // visit_orders
  bonds,     // bond_pairs
  look,      // Engine::disks_at
  fastest,   // fastest_within
  contacts,  // contacts
  sums,      // RankLead::sums
  overlaps,  // overlaps
  forget,    // Engine::forget_paths
  release,   // release_memory
  report,    // RankLead::report
  drop       // the engine is gone
};

// The same on all ranks; only what rank 0 gives counts.
RankCall agree_on(Ranks& ranks, RankCall call);

// A rank's part of the engine, and what its steps took. All calls are collective.
class RankPart {
 public:
  // threads: of this rank, for what is measured.
  RankPart(Ranks& ranks, const Scene& scene, std::unique_ptr<Engine> engine, const Threads& threads)
      : ranks_(ranks), scene_(scene), engine_(std::move(engine)), run_(blocks_on_threads(threads.count)) {}

  const Scene& scene() const { return scene_; }
  Engine& engine() const { return *engine_; }

  StateSums sums() const;

  // Null: only a state with all disks tells how deep they overlap.
  const SlabCut* cut() const;
  DeepestOverlaps overlaps() const;

  // All disks: to all->disks on rank 0, the other ranks give null; all: a copy of the part but for its disks.
  void gather(State* all) const;
  // The same at the time that rank 0 gives, which becomes that of the disks.
  void gather_at(double& t, State* all) const;

  // Of the disks of all ranks.
  double fastest_within() const;

  // The lists of the state as it is now; until the next step.
  void share_lists() { lists_ = std::make_unique<SharedLists>(ranks_, engine_->state()); }
  SharedLists& lists() { return *lists_; }

  // The disks of a moment; until the next one, or the next step. Of what is given, that of rank 0 counts.
  void show(bool within, double t) {
    shown_.reset();
    shown_ = std::make_unique<ShownDisks>(ranks_, *engine_, within, t);
  }
  ShownDisks& shown() { return *shown_; }
  double shown_overlap() const { return shown_->max_overlap(scene_, *cut()); }
  bool visit_shown_orders(const DisksInPieces::Use& use) { return shown_->visit_orders(scene_, *cut(), run_, use); }
  std::optional<std::vector<PairCounts>> shown_pairs() const { return shown_->pair_counts(scene_, *cut(), run_); }
  std::optional<BondPairs> shown_bonds() { return shown_->bond_pairs(scene_, *cut(), run_); }

  // before: what the ranks had said to each other when they began to agree on this step.
  void step(const Traffic& before);

  // Gives back what only steps and looks need.
  void release_memory();

  RankReport report() const;

 private:
  Ranks& ranks_;
  Scene scene_;
  std::unique_ptr<Engine> engine_;
  BlockRunner run_;
  std::unique_ptr<SharedLists> lists_;
  std::unique_ptr<ShownDisks> shown_;
  Count steps_ = 0;
  Traffic in_steps_;
};

// One call of the lead, on another rank. before: as of RankPart::step.
void follow(RankCall call, Ranks& ranks, RankPart& part, const Traffic& before);

}  // namespace carom
