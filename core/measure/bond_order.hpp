// The bond-orientational order psi6: how close the six nearest neighbours of each disk are to a hexagon.
#pragma once

#include <optional>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// psi6 of each disk, real and imaginary part: the mean of exp(6 i angle) over the directions to its six nearest
// neighbours (nearest images; in a sheared box those at the time of the disks). In order of storage; empty with fewer
// than seven disks. O(N log N).
std::vector<Vec2> bond_orders(const Disks& disks, const Domain& box, const BlockRunner& run = run_in_order);

inline constexpr Count least_of_bonds = 7;  // disks: one and its six neighbours

// The same for the first disks only, if the others are those around them: all disks within the distance known (length)
// of one of the first are present. Absent if a sixth neighbour may be a disk that is not present.
std::optional<std::vector<Vec2>> bond_orders_of_first(const Disks& disks, std::size_t first, const Domain& box,
                                                      double known, const BlockRunner& run = run_in_order);

// The disks with psi6 in place of their velocities, so that it can be passed in pieces as disks are; NaN if there are
// no orders.
Disks with_orders(Disks disks, const std::vector<Vec2>& orders);

struct BondOrder {
  double local = 0.0;   // mean of |psi6| over the disks: order around each; 1 on a hexagonal lattice
  double global = 0.0;  // |mean of psi6|: order with one orientation for all; 1 on a hexagonal lattice
};

// NaN with fewer than seven disks. Disks at walls have neighbours on one side only, and so little order. Summed in
// order of ids: the same bits in any storage order. O(N).
BondOrder bond_order(const DisksInPieces& orders);  // from with_orders
inline BondOrder bond_order(const Disks& disks, const Domain& box) {
  const Disks orders = with_orders(disks, bond_orders(disks, box));
  return bond_order(WholeDisks(orders, 0.0));
}

}  // namespace carom
