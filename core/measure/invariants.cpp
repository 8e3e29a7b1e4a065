#include "core/measure/invariants.hpp"

#include <algorithm>
#include <cmath>

#include "core/physics/boundary.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/reference/pair_search.hpp"

namespace carom {

namespace {

// Disks a block: sums run within blocks, then over the blocks' sums, in id order.
constexpr std::size_t sum_block = 4096;

template <class Term>
double blocked_sum(const std::vector<std::size_t>& order, const BlockRunner& run, Term&& term) {
  std::vector<double> sums((order.size() + sum_block - 1) / sum_block);
  run(sums.size(), [&](std::size_t b) {
    const std::size_t end = std::min(order.size(), (b + 1) * sum_block);
    double block = 0.0;
    for (std::size_t k = b * sum_block; k < end; ++k) block += term(order[k]);
    sums[b] = block;
  });
  double total = 0.0;
  for (const double sum : sums) total += sum;
  return total;
}

}  // namespace

Energy energy_of(const Disks& d, const std::vector<std::size_t>& order, const Gravity& gravity,
                 const BlockRunner& run) {
  Energy energy;
  energy.kinetic = blocked_sum(
      order, run, [&](std::size_t i) { return 0.5 * d.mass_of(i) * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]); });
  if (gravity.acts()) {
    energy.potential = blocked_sum(order, run, [&](std::size_t i) {
      return d.mass_of(i) * gravity.down * d.y[i] + d.mass_of(i) * gravity.left * d.x[i];
    });
  }
  return energy;
}

Energy energy_of(const Disks& d, const Gravity& gravity) {
  return energy_of(d, by_id(d), gravity, run_in_order);
}

Momentum momentum_of(const Disks& d, const std::vector<std::size_t>& order, const BlockRunner& run) {
  Momentum p;
  p.x = blocked_sum(order, run, [&](std::size_t i) { return d.mass_of(i) * d.vx[i]; });
  p.y = blocked_sum(order, run, [&](std::size_t i) { return d.mass_of(i) * d.vy[i]; });
  p.magnitude = blocked_sum(
      order, run, [&](std::size_t i) { return d.mass_of(i) * std::sqrt(d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]); });
  return p;
}

Momentum momentum_of(const Disks& d) {
  return momentum_of(d, by_id(d), run_in_order);
}

double momentum_drift(const Momentum& start, const Momentum& end) {
  const double dx = end.x - start.x;
  const double dy = end.y - start.y;
  const double scale = std::max(start.magnitude, end.magnitude);
  return scale > 0.0 ? std::sqrt(dx * dx + dy * dy) / scale : 0.0;
}

Overlap deepest_overlap(const Disks& d, const Domain& box, const BlockRunner& run) {
  const auto overlap = [&](std::uint32_t i, std::uint32_t j) {
    const double reach = d.radius_of(i) + d.radius_of(j);
    return (reach - std::sqrt(nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box))) / reach;
  };
  Overlap deepest;
  for (const Overlap& found : deepest_of_touching_pairs(d, box, run, overlap)) deepest.see(found);
  return deepest;
}

double max_overlap(const Disks& d, const Domain& box, const BlockRunner& run) {
  return deepest_overlap(d, box, run).size;
}

Overlap deepest_wall_overlap(const Disks& d, const Domain& box) {
  Overlap deepest;
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (Side side : all_sides) {
      if (box.side(side) != SideKind::wall) continue;
      const double beyond = reach_beyond_wall(side, d.x[i], d.y[i], d.radius_of(i), box) / d.radius_of(i);
      if (beyond > 0.0) deepest.see({beyond, d.id[i], wall_partner(side)});
    }
    if (box.obstacles == nullptr) continue;
    const double r = d.radius_of(i);
    for_each_solid_touched(box, d.x[i], d.y[i], r, [&](std::uint32_t k, const ObstacleGap& gap) {
      if (gap.beyond > 0.0) deepest.see({gap.beyond / r, d.id[i], obstacle_partner(k)});
    });
  }
  return deepest;
}

double wall_overlap(const Disks& d, const Domain& box) {
  return deepest_wall_overlap(d, box).size;
}

double pressure(const Energy& energy, double virial, double elapsed, const Domain& box) {
  if (!(elapsed > 0.0)) return 0.0;
  const auto inset = [&](Side side) { return box.place(side).inset; };
  const double width = box.width - (inset(Side::left) + inset(Side::right));
  const double height = box.height - (inset(Side::bottom) + inset(Side::top));
  return (energy.kinetic + virial / (2.0 * elapsed)) / (width * height);
}

}  // namespace carom
