// The disks of all ranks at a moment of the last step, which rank 0 reads piece by piece. All calls are collective; the
// arguments of rank 0 are used.
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
  // engine: of this rank; it makes no step while this exists. within: the moment is time t within the step, whose paths
  // the engine keeps; otherwise it is the step's end.
  ShownDisks(Ranks& ranks, const Engine& engine, bool within, double t);

  double time() const { return time_; }
  Count size() const { return ordered_->size(); }

  // Calls use() for piece after piece in order of id, only on rank 0. use() must not throw.
  void visit(const DisksInPieces::Use& use);

  // The largest overlap of two disks, over the sum of their radii.
  double max_overlap(const Scene& scene, const SlabCut& cut) const;

  // Calls use() in the same way for the disks with their bond order, as visit_orders() in
  // core/disks/disks_in_pieces.hpp. Returns false, on all ranks, if that is not available.
  bool visit_orders(const Scene& scene, const SlabCut& cut, const BlockRunner& run, const DisksInPieces::Use& use);

  // See slab_pairs.hpp.
  std::optional<std::vector<PairCounts>> pair_counts(const Scene& scene, const SlabCut& cut,
                                                     const BlockRunner& run) const;
  std::optional<BondPairs> bond_pairs(const Scene& scene, const SlabCut& cut, const BlockRunner& run);

 private:
  void visit(OrderedDisks& disks, const DisksInPieces::Use& use) const;
  bool find_orders(const Scene& scene, const SlabCut& cut, const BlockRunner& run);

  Ranks& ranks_;
  DiskId ids_ = 0;  // above all ids on this rank
  double time_ = 0.0;
  Disks then_;  // at a moment within the step
  const Disks* own_ = nullptr;
  std::optional<OrderedDisks> ordered_;
  std::optional<Disks> orders_;  // bond order of this rank's disks, once asked for
};

}  // namespace carom
