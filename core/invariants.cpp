#include "core/invariants.hpp"

#include <algorithm>
#include <cmath>

#include "core/boundary.hpp"
#include "core/pair_search.hpp"

namespace carom {

namespace {

// Disks a block: sums run within blocks, then over the blocks' sums, in id order.
constexpr std::size_t sum_block = 4096;

template <class Term>
double blocked_sum(const std::vector<std::size_t>& order, Term&& term) {
  double total = 0.0;
  for (std::size_t begin = 0; begin < order.size(); begin += sum_block) {
    const std::size_t end = std::min(order.size(), begin + sum_block);
    double block = 0.0;
    for (std::size_t k = begin; k < end; ++k) block += term(order[k]);
    total += block;
  }
  return total;
}

}  // namespace

Energy energy_of(const Disks& d, double gravity) {
  const std::vector<std::size_t> order = by_id(d);
  Energy energy;
  energy.kinetic =
      blocked_sum(order, [&](std::size_t i) { return 0.5 * d.mass_of(i) * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]); });
  if (gravity != 0.0) {
    energy.potential = blocked_sum(order, [&](std::size_t i) { return d.mass_of(i) * gravity * d.y[i]; });
  }
  return energy;
}

Momentum momentum_of(const Disks& d) {
  const std::vector<std::size_t> order = by_id(d);
  Momentum p;
  p.x = blocked_sum(order, [&](std::size_t i) { return d.mass_of(i) * d.vx[i]; });
  p.y = blocked_sum(order, [&](std::size_t i) { return d.mass_of(i) * d.vy[i]; });
  p.magnitude = blocked_sum(
      order, [&](std::size_t i) { return d.mass_of(i) * std::sqrt(d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]); });
  return p;
}

double max_overlap(const Disks& d, const Domain& box) {
  double worst = 0.0;
  for (const Pair& p : find_touching_pairs(d, box)) {
    double dx = d.x[p.i2] - d.x[p.i1];
    double dy = d.y[p.i2] - d.y[p.i1];
    if (box.periodic_x()) dx = nearest_image(dx, box.width);
    if (box.periodic_y()) dy = nearest_image(dy, box.height);
    const double reach = d.radius_of(p.i1) + d.radius_of(p.i2);
    worst = std::max(worst, (reach - std::sqrt(dx * dx + dy * dy)) / reach);
  }
  return worst;
}

double wall_overlap(const Disks& d, const Domain& box) {
  double worst = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (Side side : all_sides) {
      if (box.side(side) != SideKind::wall) continue;
      worst = std::max(worst, reach_beyond(side, d.x[i], d.y[i], d.radius_of(i), box) / d.radius_of(i));
    }
  }
  return worst;
}

double pressure(const Energy& energy, double virial, double elapsed, const Domain& box) {
  if (!(elapsed > 0.0)) return 0.0;
  return (energy.kinetic + virial / (2.0 * elapsed)) / (box.width * box.height);
}

}  // namespace carom
