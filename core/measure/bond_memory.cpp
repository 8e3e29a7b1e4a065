#include "core/measure/bond_memory.hpp"

#include <cmath>
#include <limits>

#include "core/measure/vectors_by_id.hpp"

namespace carom {

namespace {
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
}

void begin_memory(BondMemory& memory, const DisksInPieces& orders) {
  memory.begun = true;
  keep_by_id(orders, memory.real, memory.imaginary);
}

double bond_autocorrelation(const BondMemory& memory, const DisksInPieces& orders) {
  if (orders.size() < least_of_bonds) return unknown;
  double product = 0.0, square = 0.0;
  orders.visit([&](const Disks& psi) {
    for (const std::size_t i : by_id(psi)) {
      const std::size_t id = psi.id[i];
      if (id >= memory.real.size() || std::isnan(memory.real[id])) continue;
      const double re = memory.real[id], im = memory.imaginary[id];
      product += re * psi.vx[i] + im * psi.vy[i];
      square += re * re + im * im;
    }
  });
  return square > 0.0 ? product / square : unknown;
}

}  // namespace carom
