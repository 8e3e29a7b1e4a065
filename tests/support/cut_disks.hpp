// Disks in pieces, as from several ranks.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "core/disks/disk_columns.hpp"
#include "core/disks/disks_in_pieces.hpp"

namespace carom::test {

// Pieces of a fixed number of ids, in descending order of id within each; all have columns of radii and masses.
class CutDisks final : public DisksInPieces {
 public:
  CutDisks(const Disks& disks, double time, DiskId ids) : disks_(disks), order_(by_id(disks)), time_(time), ids_(ids) {}
  double time() const override { return time_; }
  Count size() const override { return disks_.size(); }
  const Disks& whole() const override {
    ADD_FAILURE() << "asks for all disks";
    return disks_;
  }
  std::optional<double> max_overlap() const override { return 0.125; }
  void visit(const Use& use) const override {
    std::vector<std::size_t> piece;
    for (std::size_t k = 0; k <= order_.size(); ++k) {
      const bool next = k == order_.size() || (!piece.empty() && number_of(order_[k]) != number_of(piece.front()));
      if (next) hand_out(piece, use);
      if (k < order_.size()) piece.push_back(order_[k]);
    }
  }

 private:
  DiskId number_of(std::size_t i) const { return disks_.id[i] / ids_; }
  void hand_out(std::vector<std::size_t>& piece, const Use& use) const {
    Disks some;
    some.inertia = disks_.inertia;
    for (auto i = piece.rbegin(); i != piece.rend(); ++i) {
      push_back(some, disk_at(disks_, *i), {.radius = true, .mass = true, .spin = some.spins()});
    }
    piece.clear();
    use(some);
  }

  const Disks& disks_;
  std::vector<std::size_t> order_;
  double time_;
  DiskId ids_;
};

}  // namespace carom::test
