#include "core/measure/bond_order.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "core/measure/nearest_disks.hpp"

namespace carom {

namespace {

Vec2 product(Vec2 a, Vec2 b) {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

// exp(6 i angle) by powers of exp(i angle), which is the direction itself.
Vec2 sixfold(const Neighbour& n) {
  const double r = std::sqrt(n.distance2);
  if (r == 0.0) return {};
  const Vec2 z{n.apart.x / r, n.apart.y / r};
  const Vec2 cube = product(z, product(z, z));
  return product(cube, cube);
}

Vec2 order_of(const NearestNeighbours& nearest) {
  Vec2 order{};
  for (const Neighbour& n : nearest) {
    const Vec2 bond = sixfold(n);
    order.x += bond.x / neighbours_of_bonds;
    order.y += bond.y / neighbours_of_bonds;
  }
  return order;
}

}  // namespace

std::vector<Vec2> bond_orders(const Disks& d, const Domain& box, const BlockRunner& run) {
  if (d.size() < least_of_bonds) return {};
  return *bond_orders_of_first(d, d.size(), box, HUGE_VAL, run);
}

std::optional<std::vector<Vec2>> bond_orders_of_first(const Disks& d, std::size_t first, const Domain& box,
                                                      double known, const BlockRunner& run) {
  constexpr std::size_t block = 4096;  // disks
  if (first == 0) return std::vector<Vec2>();
  if (d.size() < least_of_bonds) return std::nullopt;
  const NearestDisks disks(d, box, run);
  std::vector<Vec2> orders(first);
  std::atomic<bool> all_known = true;
  run((d.size() + block - 1) / block, [&](std::size_t b) {
    for (std::size_t k = b * block; k < std::min(d.size(), (b + 1) * block) && all_known; ++k) {
      const std::size_t i = disks.disk(k);
      if (i >= first) continue;
      const NearestNeighbours found = disks.of(k);
      if (found.back().distance2 > known * known) {
        all_known = false;
        return;
      }
      orders[i] = order_of(found);
    }
  });
  if (!all_known) return std::nullopt;
  return orders;
}

Disks with_orders(Disks d, const std::vector<Vec2>& orders) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < d.size(); ++i) {
    d.vx[i] = orders.empty() ? nothing : orders[i].x;
    d.vy[i] = orders.empty() ? nothing : orders[i].y;
  }
  return d;
}

BondOrder bond_order(const DisksInPieces& orders) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (orders.size() < least_of_bonds) return {nothing, nothing};
  Vec2 all;
  double local = 0.0;
  orders.visit([&](const Disks& psi) {
    for (const std::size_t i : by_id(psi)) {
      local += std::sqrt(psi.vx[i] * psi.vx[i] + psi.vy[i] * psi.vy[i]);
      all.x += psi.vx[i];
      all.y += psi.vy[i];
    }
  });
  const auto n = static_cast<double>(orders.size());
  return {local / n, std::sqrt(all.x * all.x + all.y * all.y) / n};
}

}  // namespace carom
