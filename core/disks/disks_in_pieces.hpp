// All disks at one moment, in pieces: for one rank of several, which must not hold all of them.
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

  // Calls use() for piece after piece. All ids of a piece are above those of the piece before; within a piece the order
  // is free. Radius, mass and spin are those of whole(). An exception thrown by use() ends the visit. use() must not
  // call these disks or their engine.
  virtual void visit(const Use& use) const = 0;

  // The largest overlap of two disks over the sum of their radii, if it is known without gathering all disks.
  virtual std::optional<double> max_overlap() const { return std::nullopt; }

  // The pairs that the scene's [analysis] counts (core/measure/pair_records.hpp), if they are known without gathering
  // all disks.
  virtual std::optional<std::vector<PairCounts>> pair_counts() const { return std::nullopt; }

  // As visit(), for the disks that the scene's [analysis] measures, with psi6 in place of velocities
  // (core/measure/bond_order.hpp). Returns false, without a call, if that needs all disks.
  virtual bool visit_orders(const Use& /*use*/) const { return false; }

  // The pairs of the bond correlation (core/measure/bond_correlation.hpp), if they are known without gathering all
  // disks. Absent with fewer than seven disks, too.
  virtual std::optional<BondPairs> bond_pairs() const { return std::nullopt; }

  // All disks at once. Several ranks gather them on this one.
  virtual const Disks& whole() const = 0;
};

// Disks that are all in this program. They must outlive this object.
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
