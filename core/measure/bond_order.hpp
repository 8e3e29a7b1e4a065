// The bond-orientational order psi6: how near the six nearest neighbours of each disk come to a hexagon.
#pragma once

#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// psi6 of each disk, real and imaginary part: the mean of exp(6 i angle) over the directions to its six nearest
// neighbours (nearest images; of a sheared box at the time of the disks). In order of storage; empty with fewer than
// seven disks. O(N).
std::vector<Vec2> bond_orders(const Disks& disks, const Domain& box);

struct BondOrder {
  double local = 0.0;   // mean of |psi6| over the disks: order around each; 1 on a hexagonal lattice
  double global = 0.0;  // |mean of psi6|: one orientation for all; likewise
};

// NaN with fewer than seven disks. Disks at walls have neighbours on one side only, and little order. In order of ids:
// the same bits in any storage order. O(N).
BondOrder bond_order(const Disks& disks, const Domain& box);

}  // namespace carom
