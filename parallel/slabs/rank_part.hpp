// Each rank's part of the engine that rank 0 leads (leading_engine.hpp), and the calls that rank 0 can make on all
// ranks.
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

// Rank 0's next call: which function of the lead, or of its engine, was called there.
enum class RankCall : std::int64_t {
  end,       // RankLead::end
  make,      // make_engine
  begin,     // make_engine_at_start
  step,      // Engine::step
  collect,   // state
  lists,     // pieces
  piece,     // a piece of one of those lists
  show,      // pieces_at
  some,      // some of these disks: DisksInPieces::visit
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
  drop       // the engine is destroyed
};

// Returns rank 0's call on all ranks; the argument of the others does not matter.
RankCall agree_on(Ranks& ranks, RankCall call);

// A rank's part of the engine, and the cost of its steps. All calls are collective.
class RankPart {
 public:
  // threads: of this rank, for measurements.
  RankPart(Ranks& ranks, const Scene& scene, std::unique_ptr<Engine> engine, const Threads& threads)
      : ranks_(ranks), scene_(scene), engine_(std::move(engine)), run_(blocks_on_threads(threads.count)) {}

  const Scene& scene() const { return scene_; }
  Engine& engine() const { return *engine_; }

  StateSums sums() const;

  // Null if only a state with all disks gives the depths of overlaps.
  const SlabCut* cut() const;
  DeepestOverlaps overlaps() const;

  // Collects all disks in all->disks on rank 0; the other ranks pass null. all: a copy of the part without disks.
  void gather(State* all) const;
  // The same at the time given by rank 0; t becomes the time of the disks.
  void gather_at(double& t, State* all) const;

  // Of the disks of all ranks.
  double fastest_within() const;

  // Prepares the lists of the present state; they are valid until the next step.
  void share_lists() { lists_ = std::make_unique<SharedLists>(ranks_, engine_->state()); }
  SharedLists& lists() { return *lists_; }

  // Shows the disks of a moment, until the next call or the next step. The arguments of rank 0 are used.
  void show(bool within, double t) {
    shown_.reset();
    shown_ = std::make_unique<ShownDisks>(ranks_, *engine_, within, t);
  }
  ShownDisks& shown() { return *shown_; }
  double shown_overlap() const { return shown_->max_overlap(scene_, *cut()); }
  bool visit_shown_orders(const DisksInPieces::Use& use) { return shown_->visit_orders(scene_, *cut(), run_, use); }
  std::optional<std::vector<PairCounts>> shown_pairs() const { return shown_->pair_counts(scene_, *cut(), run_); }
  std::optional<BondPairs> shown_bonds() { return shown_->bond_pairs(scene_, *cut(), run_); }

  // before: traffic of the ranks when they began to agree on this step.
  void step(const Traffic& before);

  // Frees memory that only steps and analyses need.
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

// Runs one call of the lead on another rank. before: as for RankPart::step.
void follow(RankCall call, Ranks& ranks, RankPart& part, const Traffic& before);

}  // namespace carom
