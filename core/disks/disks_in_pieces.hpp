// The disks of a moment in pieces, for a program that must not have all of them at once: one rank of several.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/pair_counts.hpp"

namespace carom {

class DisksInPieces {
 public:
  using Use = std::function<void(const Disks&)>;

  DisksInPieces() = default;
  DisksInPieces(const DisksInPieces&) = delete;
  DisksInPieces& operator=(const DisksInPieces&) = delete;
  virtual ~DisksInPieces() = default;

  virtual double time() const = 0;
  virtual Count size() const = 0;  // of all pieces

  // Calls use() for piece after piece: all ids of a piece are above those of the one before, and within it disks have
  // any order. Each disk has the radius, the mass and the spin that it has in whole(). What use() throws ends it;
  // use() asks nothing else of these disks or of their engine.
  virtual void visit(const Use& use) const = 0;

  // The largest overlap of two disks over the sum of their radii, where that is known without all disks.
  virtual std::optional<double> max_overlap() const { return std::nullopt; }

  // The pairs that the scene's [analysis] counts (core/measure/pair_records.hpp), where they are counted without all
  // disks.
  virtual std::optional<std::vector<PairCounts>> pair_counts() const { return std::nullopt; }

  // Calls use() as visit() does, for the disks that the scene's [analysis] measures, with psi6 in place of velocities
  // (core/measure/bond_order.hpp). False, with no call, where all disks are needed for that.
  virtual bool visit_orders(const Use& /*use*/) const { return false; }

  // The pairs that its bond correlation is made of (core/measure/bond_correlation.hpp), likewise; absent with fewer
  // than seven disks, too.
  virtual std::optional<BondPairs> bond_pairs() const { return std::nullopt; }

  // All of them at once: of several ranks, on this one.
  virtual const Disks& whole() const = 0;
};

// Disks that are here as a whole; they outlive this.
class WholeDisks final : public DisksInPieces {
 public:
  WholeDisks(const Disks& disks, double time) : disks_(disks), time_(time) {}

  double time() const override { return time_; }
  Count size() const override { return disks_.size(); }
  void visit(const Use& use) const override { use(disks_); }
  const Disks& whole() const override { return disks_; }

 private:
  const Disks& disks_;
  double time_;
};

}  // namespace carom
