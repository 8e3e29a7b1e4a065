#include "core/measure/invariants.hpp"

#include <algorithm>
#include <cmath>

#include "core/physics/wall_overlap.hpp"
#include "core/reference/pair_search.hpp"

namespace carom {

Energy energy_of(const Disks& d, const std::vector<std::size_t>& order, const Gravity& gravity,
                 const BlockRunner& run) {
  Energy energy;
  energy.kinetic = blocked_sum(order, run, [&](std::size_t i) { return kinetic_energy_of(d, i); });
  if (gravity.acts()) {
    energy.potential = blocked_sum(order, run, [&](std::size_t i) { return potential_energy_of(d, i, gravity); });
  }
  if (d.spins()) {
    energy.rotational = blocked_sum(order, run, [&](std::size_t i) { return rotational_energy_of(d, i); });
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
  p.magnitude = blocked_sum(order, run, [&](std::size_t i) { return momentum_magnitude_of(d, i); });
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
  for (const Overlap& found : deepest_of_touching_pairs(d, box, run, overlap)) deepest.raise_to(found);
  return deepest;
}

double max_overlap(const Disks& d, const Domain& box, const BlockRunner& run) {
  return deepest_overlap(d, box, run).size;
}

Overlap deepest_wall_overlap(const Disks& d, const Domain& box) {
  return deepest_wall_overlap(d, box, 0, d.size());
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
