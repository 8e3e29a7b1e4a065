// The order in which disks are placed at random: large ones first, and of equal ones the one with the smaller id.
#pragma once

#include <cstddef>
#include <vector>

#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/start_disks.hpp"

namespace carom {

struct DiskToPlace {
  DiskId id = 0;
  double radius = 0.0;  // length
};

// Successive disks whose radii differ by less than a factor of two: a PlacementSearch learns anew for each class where
// there is room.
struct SizeClass {
  double largest = 0.0, smallest = 0.0;  // radii
  std::size_t disks = 0;
};

// No rank knows the order of all disks: each has a share of them, in order, and they tell each other which come next.
// All calls are collective, and give the same result on all ranks.
class PlacementOrder {
 public:
  // disks outlives this.
  PlacementOrder(const StartDisks& disks, Ranks& ranks);

  // The class that comes next; none of its disks has been given. After the last one, a class without disks.
  SizeClass next_class() const;
  // The next disks of the class: at most `most`, and at least one if there is one.
  std::vector<DiskToPlace> next(const SizeClass& of, std::size_t most);

 private:
  const StartDisks& disks_;
  Ranks& ranks_;
  bool equal_ = false;     // are all radii equal? Then the order is that of ids
  std::size_t given_ = 0;  // number of disks given, on all ranks
  // If radii differ: this rank's share.
  std::vector<DiskToPlace> share_;
  std::size_t given_here_ = 0;
};

}  // namespace carom
