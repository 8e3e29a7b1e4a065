// The six nearest neighbours of each disk, at any density.
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
    std::array<Neighbour, neighbours_of_bonds>;  // nearest first; of two at the same distance, the lower id first

// The centres in a tree: each node divides its disks into halves across the longer side of their bounding rectangle. If
// most disks are in a few places of the box, cells of one size would hold too many disks, or be too many.
class NearestDisks {
 public:
  // The box must outlive it. Precondition: seven disks or more.
  NearestDisks(const Disks& disks, const Domain& box, const BlockRunner& run);

  // The storage index of the k-th disk, in an order that keeps disks near each other together.
  std::size_t disk(std::size_t k) const { return centres_[k].disk; }

  // The neighbours of the k-th disk, by distances to nearest images. O(log N).
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
  std::size_t first_leaf_ = 0;  // nodes from here on are leaves; node k before has children 2 k + 1 and 2 k + 2
  std::vector<Node> nodes_;
  std::vector<Centre> centres_;  // contiguous for each node
};

}  // namespace carom
