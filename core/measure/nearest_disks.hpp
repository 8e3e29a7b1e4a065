// The six nearest neighbours of each disk, whatever the density around it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

struct Neighbour {
  double distance2;
  DiskId id;
  Vec2 apart;
  bool operator<(const Neighbour& other) const { return std::tie(distance2, id) < std::tie(other.distance2, other.id); }
};

inline constexpr std::size_t neighbours_of_bonds = 6;
using NearestNeighbours =
    std::array<Neighbour, neighbours_of_bonds>;  // nearest first; of equally far ones the lowest id

// Centres in a tree: each node halves the disks below it across the longer side of the rectangle that they lie in.
// Where most disks are in a few places of the box, cells of one size would have far too many in them, or be far too
// many.
class NearestDisks {
 public:
  // The box must outlive it. Precondition: seven disks or more.
  NearestDisks(const Disks& disks, const Domain& box, const BlockRunner& run);

  // The k-th of all disks, in an order in which those near each other come soon after each other.
  std::size_t disk(std::size_t k) const { return centres_[k].disk; }

  // Of that disk, by its distance from the nearest image of each of the others. O(log N).
  NearestNeighbours of(std::size_t k) const;

 private:
  struct Centre {
    double x, y;  // length
    std::uint32_t disk;
    DiskId id;
  };
  // Centres lie between low and high; length.
  struct Node {
    Vec2 low, high;
  };
  class Search;

  struct Span {
    std::size_t begin, end;
  };
  std::size_t halve(std::size_t node, Span span);
  void divide(std::size_t node, Span span);
  Vec2 apart(const Centre& from, const Centre& to) const;
  Vec2 nearest_of_rows(Vec2 raw) const;

  const Domain& box_;
  std::size_t first_leaf_ = 0;  // the nodes from here on have no nodes below them, those before two each, at 2 k + 1
  std::vector<Node> nodes_;
  std::vector<Centre> centres_;  // those of a node lie one after the other
};

}  // namespace carom
