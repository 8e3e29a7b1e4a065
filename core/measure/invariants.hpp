// Conserved quantities of a state, and the overlaps that hard disks would not have.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"
#include "core/disks/overlap.hpp"
#include "core/physics/roughness.hpp"

namespace carom {

struct Energy {
  double kinetic = 0.0;     // sum of m v^2 / 2
  double potential = 0.0;   // sum of -m g r, 0 at the lower left corner
  double rotational = 0.0;  // of rough disks: sum of I w^2 / 2
  double total() const { return kinetic + potential + rotational; }
};

struct Momentum {
  double x = 0.0, y = 0.0;
  double magnitude = 0.0;  // sum of m |v|, the scale for a relative drift
};

// Disks in a block: sums run within blocks, then over the blocks' sums, in order of id.
inline constexpr std::size_t sum_block = 4096;

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

// Energy of disk i.
inline double kinetic_energy_of(const Disks& d, std::size_t i) {
  return 0.5 * d.mass_of(i) * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
}
inline double potential_energy_of(const Disks& d, std::size_t i, const Gravity& gravity) {
  return d.mass_of(i) * gravity.down * d.y[i] + d.mass_of(i) * gravity.left * d.x[i];
}
inline double rotational_energy_of(const Disks& d, std::size_t i) {
  return rotational_energy(d.inertia, d.mass_of(i), d.radius_of(i), d.spin[i]);
}
inline double momentum_magnitude_of(const Disks& d, std::size_t i) {
  return d.mass_of(i) * std::sqrt(d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
}

// Sums run in order of id within blocks of fixed size: the same bits for any storage order and number of threads.
Energy energy_of(const Disks& disks, const Gravity& gravity);
Momentum momentum_of(const Disks& disks);

// The same with order = by_id(disks), and blocks run by `run`.
Energy energy_of(const Disks& disks, const std::vector<std::size_t>& order, const Gravity& gravity,
                 const BlockRunner& run);
Momentum momentum_of(const Disks& disks, const std::vector<std::size_t>& order, const BlockRunner& run);

// |end - start| over the larger of the two sums of m |v|; 0 if nothing moves.
double momentum_drift(const Momentum& start, const Momentum& end);

// Largest overlap of two disks over the sum of their radii (nearest image), 0 if none; uses a grid, O(N).
double max_overlap(const Disks& disks, const Domain& box, const BlockRunner& run = run_in_order);

// Largest reach of a disk beyond a wall side over its radius, 0 if none.
double wall_overlap(const Disks& disks, const Domain& box);

// The larger of the two, with the ids of the disks.
Overlap deepest_overlap(const Disks& disks, const Domain& box, const BlockRunner& run = run_in_order);
Overlap deepest_wall_overlap(const Disks& disks, const Domain& box);

// P A = K + virial / (2 elapsed) (virial theorem in two dimensions; ideal part K = N kT). 0 if elapsed is 0. A is the
// area between the sides at their present places.
double pressure(const Energy& energy, double virial, double elapsed, const Domain& box);

}  // namespace carom
