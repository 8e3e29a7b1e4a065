#include "core/measure/bond_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/measure/bond_order.hpp"

namespace carom {

namespace {
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
}

void begin_memory(BondMemory& memory, const Disks& d, const Domain& box) {
  const std::size_t ids = d.empty() ? 0 : *std::max_element(d.id.begin(), d.id.end()) + std::size_t{1};
  memory.begun = true;
  memory.real.assign(ids, unknown);
  memory.imaginary.assign(ids, unknown);
  const std::vector<Vec2> orders = bond_orders(d, box);
  for (std::size_t i = 0; i < orders.size(); ++i) {
    memory.real[d.id[i]] = orders[i].x;
    memory.imaginary[d.id[i]] = orders[i].y;
  }
}

double bond_autocorrelation(const BondMemory& memory, const Disks& d, const Domain& box) {
  const std::vector<Vec2> orders = bond_orders(d, box);
  if (orders.empty()) return unknown;
  double product = 0.0, square = 0.0;
  for (const std::size_t i : by_id(d)) {
    const std::size_t id = d.id[i];
    if (id >= memory.real.size() || std::isnan(memory.real[id])) continue;
    const double re = memory.real[id], im = memory.imaginary[id];
    product += re * orders[i].x + im * orders[i].y;
    square += re * re + im * im;
  }
  return square > 0.0 ? product / square : unknown;
}

}  // namespace carom
