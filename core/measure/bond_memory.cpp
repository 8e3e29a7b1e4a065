#include "core/measure/bond_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
}

void begin_memory(BondMemory& memory, const DisksInPieces& orders) {
  memory.begun = true;
  // Ids begin without gaps: room that need not grow piece by piece.
  memory.real.reserve(orders.size());
  memory.imaginary.reserve(orders.size());
  orders.visit([&](const Disks& psi) {
    if (psi.empty()) return;
    const std::size_t ids = *std::max_element(psi.id.begin(), psi.id.end()) + std::size_t{1};
    memory.real.resize(ids, unknown);
    memory.imaginary.resize(ids, unknown);
    for (std::size_t i = 0; i < psi.size(); ++i) {
      memory.real[psi.id[i]] = psi.vx[i];
      memory.imaginary[psi.id[i]] = psi.vy[i];
    }
  });
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
