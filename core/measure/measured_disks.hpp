// Views of the disks for measurements, whole or in pieces: only those of a group, with velocities relative to a shear
// flow, or with psi6.
#pragma once

#include <optional>

#include "core/base/block_runner.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The disks with these ids.
Disks disks_of(const Disks& all, const IdRange& ids);

// The same as a view of disks, which must outlive it; without ids, all disks.
class DisksOfGroup final : public DisksInPieces {
 public:
  DisksOfGroup(const DisksInPieces& all, const std::optional<IdRange>& ids);

  double time() const override { return all_.time(); }
  Count size() const override { return size_; }
  void visit(const Use& use) const override;
  const Disks& whole() const override;

 private:
  const DisksInPieces& all_;
  std::optional<IdRange> ids_;
  Count size_;
  mutable std::optional<Disks> whole_;  // once asked for
};

// A view with velocities relative to the flow of a sheared box. Disks and box must outlive it.
class DisksInFlow final : public DisksInPieces {
 public:
  DisksInFlow(const DisksInPieces& disks, const Domain& box) : disks_(disks), box_(box) {}

  double time() const override { return disks_.time(); }
  Count size() const override { return disks_.size(); }
  void visit(const Use& use) const override;
  const Disks& whole() const override;

 private:
  const DisksInPieces& disks_;
  const Domain& box_;
  mutable std::optional<Disks> whole_;  // once asked for
};

// A view with psi6 in place of velocities (with_orders). Each rank computes psi6 of its own disks if it can; otherwise
// all disks are gathered. all: all disks, of which `disks` are measured. box: at their time. All arguments must outlive
// the view.
class DisksWithOrders final : public DisksInPieces {
 public:
  DisksWithOrders(const DisksInPieces& all, const DisksInPieces& disks, const Domain& box, const BlockRunner& run)
      : all_(all), disks_(disks), box_(box), run_(run) {}

  double time() const override { return disks_.time(); }
  Count size() const override { return disks_.size(); }
  void visit(const Use& use) const override;
  const Disks& whole() const override;

 private:
  const DisksInPieces& all_;
  const DisksInPieces& disks_;
  const Domain& box_;
  const BlockRunner& run_;
  mutable std::optional<Disks> whole_;  // once asked for
};

}  // namespace carom
