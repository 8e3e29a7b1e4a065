#include "core/measure/state_sums.hpp"

#include <algorithm>
#include <memory>

#include "core/disks/fastest_speed.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/validity.hpp"

namespace carom {

void StateTally::add(const Disks& d, const std::vector<std::size_t>& order) {
  if (d.empty()) return;
  const Gravity& gravity = scene_.physics.gravity;
  for (const std::size_t i : order) {
    kinetic_.add(kinetic_energy_of(d, i));
    if (gravity.acts()) potential_.add(potential_energy_of(d, i, gravity));
    if (d.spins()) rotational_.add(rotational_energy_of(d, i));
    px_.add(d.mass_of(i) * d.vx[i]);
    py_.add(d.mass_of(i) * d.vy[i]);
    magnitude_.add(momentum_magnitude_of(d, i));
    if (!box_.shear.acts()) continue;
    const double ux = d.vx[i] - box_.shear.flow(d.y[i], box_.height);
    relative_.add(0.5 * d.mass_of(i) * (ux * ux + d.vy[i] * d.vy[i]));
  }
  const double smallest = smallest_radius(d);
  sums_.smallest_radius = sums_.at.particles == 0 ? smallest : std::min(sums_.smallest_radius, smallest);
  sums_.fastest = std::max(sums_.fastest, fastest_speed(d));
  sums_.at.particles += d.size();
  hashes_ += sum_of_hashes(d);
}

StateSums StateTally::sums() const {
  StateSums sums = sums_;
  sums.at.energy = {kinetic_.value(), potential_.value(), rotational_.value()};
  sums.at.momentum = {px_.value(), py_.value(), magnitude_.value()};
  sums.at.relative = box_.shear.acts() ? relative_.value() : kinetic_.value();
  sums.hash = state_hash(static_cast<std::size_t>(sums.at.particles), hashes_);
  return sums;
}

StateSums sums_of(const State& state, const Scene& scene) {
  StateTally tally(scene, state.time);
  tally.add(state.disks, by_id(state.disks));
  return tally.sums();
}

DeepestOverlaps overlaps_of(const State& state, const Scene& scene) {
  Domain box = box_at(scene.box, state.time);
  const Overlap of_disks = deepest_overlap(state.disks, box);
  const std::unique_ptr<const ObstacleCells> obstacles = place_obstacles(state.obstacles, box, motions_of(scene));
  return {of_disks, deepest_wall_overlap(state.disks, box)};
}

}  // namespace carom
