// The disks of all ranks at a moment of the last step, which rank 0 looks at piece by piece. All calls are collective;
// of what is asked, that of rank 0 counts.
#pragma once

#include <optional>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/measure/pair_distances.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/ordered_disks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

class ShownDisks {
 public:
  // engine: of this rank; it makes no step as long as this is there. within: at time t within the step, which it knows;
  // otherwise, at the end of it.
  ShownDisks(Ranks& ranks, const Engine& engine, bool within, double t);

  double time() const { return time_; }
  Count size() const { return ordered_->size(); }

  // Calls use() for piece after piece in order of id, on rank 0 alone. It must not throw.
  void visit(const DisksInPieces::Use& use);

  // The largest of two disks, over the sum of their radii.
  double max_overlap(const Scene& scene, const SlabCut& cut) const;

  // The same of what visit_orders() has of them (core/disks/disks_in_pieces.hpp). False, on all ranks, where there is
  // no such thing.
  bool visit_orders(const Scene& scene, const SlabCut& cut, const BlockRunner& run, const DisksInPieces::Use& use);

  // See slab_pairs.hpp.
  std::optional<std::vector<PairCounts>> pair_counts(const Scene& scene, const SlabCut& cut,
                                                     const BlockRunner& run) const;
  std::optional<BondPairs> bond_pairs(const Scene& scene, const SlabCut& cut, const BlockRunner& run);

 private:
  void visit(OrderedDisks& disks, const DisksInPieces::Use& use) const;
  bool find_orders(const Scene& scene, const SlabCut& cut, const BlockRunner& run);

  Ranks& ranks_;
  DiskId ids_ = 0;  // above all of this rank
  double time_ = 0.0;
  Disks then_;  // of a moment within the step
  const Disks* own_ = nullptr;
  std::optional<OrderedDisks> ordered_;
  std::optional<Disks> orders_;  // of this rank's disks, once asked for
};

}  // namespace carom
