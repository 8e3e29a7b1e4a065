// The disks that a measurement is of, as they come, whole or in pieces: those of a group, and with velocities relative
// to a shear flow.
#pragma once

#include <optional>

#include "core/base/block_runner.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Those with these ids.
Disks disks_of(const Disks& all, const IdRange& ids);

// The same of disks that outlive this; without ids, all of them.
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

// With velocities relative to the flow, where the box is sheared; all of it outlives this.
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

// With psi6 in place of velocities (with_orders), found by those that have the disks, or else among all of them. all:
// of which the disks are those that are measured. box: at their time. All of it outlives this.
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
