// The autocorrelation of psi6 in time, g6(t).
#pragma once

#include <vector>

#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"
#include "core/measure/bond_order.hpp"

namespace carom {

// psi6 of the first sample, by id, real and imaginary part; NaN: no such disk.
struct BondMemory {
  bool begun = false;
  std::vector<double> real, imaginary;
};

// With fewer than seven disks the memory stays empty.
void begin_memory(BondMemory& memory, const DisksInPieces& orders);  // with_orders
inline void begin_memory(BondMemory& memory, const Disks& disks, const Domain& box) {
  const Disks orders = with_orders(disks, bond_orders(disks, box));
  begin_memory(memory, WholeDisks(orders, 0.0));
}

// g6(t) = Re(sum of psi6(0)* psi6(t)) / sum of |psi6(0)|^2 over the disks of the first sample that are still there: 1
// at first. NaN without any, with fewer than seven disks, and where all psi6(0) are 0. In order of ids: the same bits
// in any storage order. O(N).
double bond_autocorrelation(const BondMemory& memory, const DisksInPieces& orders);  // with_orders
inline double bond_autocorrelation(const BondMemory& memory, const Disks& disks, const Domain& box) {
  const Disks orders = with_orders(disks, bond_orders(disks, box));
  return bond_autocorrelation(memory, WholeDisks(orders, 0.0));
}

}  // namespace carom
