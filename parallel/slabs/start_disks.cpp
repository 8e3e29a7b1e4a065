#include "parallel/slabs/start_disks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/physics/roughness.hpp"
#include "core/start/initial_velocities.hpp"
#include "parallel/ranks/message.hpp"

namespace carom {

StartDisks::StartDisks(const Scene& scene, Ranks& ranks)
    : scene_(scene), ranks_(ranks), lattices_(scene.groups.size()), motions_(scene.groups.size()) {
  for (const DiskGroup& group : scene.groups) {
    first_ids_.push_back(static_cast<DiskId>(disks_));
    disks_ += group.count;
  }
  see_sizes();
}

GroupRange StartDisks::share(std::size_t group) const {
  const auto ranks = static_cast<Count>(ranks_.count());
  const auto rank = static_cast<Count>(ranks_.rank());
  const Count each = scene_.groups[group].count / ranks;
  return {each * rank, rank + 1 == ranks ? scene_.groups[group].count : each * (rank + 1)};
}

DiskSize StartDisks::size_of(std::size_t group, Count k) const {
  const DiskGroup& g = scene_.groups[group];
  return draw_size(g.radius, g.mass, scene_.seed, Stream::radius, Stream::mass, id_of(group, k), k);
}

void StartDisks::see_sizes() {
  // The maxima of each quantity, and of its negative.
  std::vector<double> most(4 + groups(), -std::numeric_limits<double>::infinity());
  for (std::size_t g = 0; g < groups(); ++g) {
    GroupRange range = share(g);
    const bool equal = same_for_all(scene_.groups[g].radius, scene_.groups[g].mass);
    if (equal) range = {0, std::min<Count>(1, scene_.groups[g].count)};
    for (Count k = range.first; k < range.last; ++k) {
      const DiskSize size = size_of(g, k);
      most[0] = std::max(most[0], size.radius);
      most[1] = std::max(most[1], -size.radius);
      most[2] = std::max(most[2], size.mass);
      most[3] = std::max(most[3], -size.mass);
      most[4 + g] = std::max(most[4 + g], size.radius);
    }
  }
  ranks_.maximum(most);
  sizes_ = {{-most[1], -most[3]}, {most[0], most[2]}, {most.begin() + 4, most.end()}};
}

void StartDisks::place() {
  for (std::size_t g = 0; g < groups(); ++g) {
    if (scene_.groups[g].count > 0) lattices_[g].emplace(scene_, g, sizes_.group_largest[g]);
  }
}

GroupRange StartDisks::between(std::size_t group, double low, double high) const {
  const auto first_from = [&](double height_wanted) {
    Count below = 0;
    Count end = scene_.groups[group].count;
    while (below < end) {
      const Count middle = below + (end - below) / 2;
      if (height(group, middle) < height_wanted) {
        below = middle + 1;
      } else {
        end = middle;
      }
    }
    return below;
  };
  const Count first = first_from(low);
  return {first, std::max(first, first_from(high))};
}

// The sums of one machine add one disk after the other: so each rank continues the sum of the one before it.
template <class Sum, class Add>
void StartDisks::sum_in_order(std::size_t group, Sum& sum, Add&& add) {
  for (int rank = 0; rank < ranks_.count(); ++rank) {
    Bytes here;
    if (rank == ranks_.rank()) {
      const GroupRange range = share(group);
      for (Count k = range.first; k < range.last; ++k) add(k);
      put(here, sum);
    }
    sum = MessageReader(ranks_.gather(here)[static_cast<std::size_t>(rank)]).template get<Sum>();
  }
}

void StartDisks::sum_motions() {
  const double inertia = scene_.physics.surfaces.inertia;
  for (std::size_t g = 0; g < groups(); ++g) {
    const DiskGroup& group = scene_.groups[g];
    const auto count = static_cast<double>(group.count);
    DrawnMotion& motion = motions_[g];
    if (group.count == 0) continue;
    if (group.velocities.kind == VelocityLaw::Kind::maxwell && group.velocities.temperature != 0.0) {
      GroupMomentum momentum;
      sum_in_order(g, momentum, [&](Count k) {
        const double mass = size_of(g, k).mass;
        momentum.add(mass, maxwell_velocity(scene_, group.velocities.temperature, id_of(g, k), mass));
      });
      motion.mean = momentum.mean_velocity();
      double kinetic = 0.0;
      sum_in_order(g, kinetic, [&](Count k) {
        const double mass = size_of(g, k).mass;
        const Vec2 v = drawn_velocity(g, k, mass);
        kinetic += 0.5 * mass * (v.x * v.x + v.y * v.y);
      });
      motion.factor = std::sqrt(count * group.velocities.temperature / kinetic);
    }
    if (!(inertia > 0.0) || !(group.spins.temperature > 0.0)) continue;
    double twice_energy = 0.0;
    sum_in_order(g, twice_energy, [&](Count k) {
      const DiskSize size = size_of(g, k);
      const double spin = thermal_spin(scene_, group.spins.temperature, id_of(g, k), inertia, size.mass, size.radius);
      twice_energy += 2.0 * rotational_energy(inertia, size.mass, size.radius, spin);
    });
    motion.spin_factor = std::sqrt(count * group.spins.temperature / twice_energy);
  }
}

// The velocity before it is scaled.
Vec2 StartDisks::drawn_velocity(std::size_t group, Count k, double mass) const {
  const VelocityLaw& law = scene_.groups[group].velocities;
  if (law.kind == VelocityLaw::Kind::uniform) return uniform_velocity(scene_, law.limit, id_of(group, k));
  if (law.kind == VelocityLaw::Kind::list && k < law.list.size()) return law.list[k];
  if (law.kind != VelocityLaw::Kind::maxwell || law.temperature == 0.0) return {};
  Vec2 v = maxwell_velocity(scene_, law.temperature, id_of(group, k), mass);
  v.x -= motions_[group].mean.x;
  v.y -= motions_[group].mean.y;
  return v;
}

Disk StartDisks::disk_at(std::size_t group, Count k, Vec2 place) const {
  const DiskGroup& g = scene_.groups[group];
  const DrawnMotion& motion = motions_[group];
  const DiskSize size = size_of(group, k);
  Disk disk{place.x, place.y, 0.0, 0.0, size.radius, size.mass, id_of(group, k), 0.0};
  const Vec2 v = drawn_velocity(group, k, disk.mass);
  const bool scaled = g.velocities.kind == VelocityLaw::Kind::maxwell && g.velocities.temperature != 0.0;
  disk.vx = scaled ? v.x * motion.factor : v.x;
  disk.vy = scaled ? v.y * motion.factor : v.y;
  if (!(g.drift == Vec2{})) {
    disk.vx += g.drift.x;
    disk.vy += g.drift.y;
  }
  const double inertia = scene_.physics.surfaces.inertia;
  if (!(inertia > 0.0)) return disk;
  disk.spin = g.spins.list.empty() ? g.spins.value : g.spins.list[static_cast<std::size_t>(k)];
  if (g.spins.temperature > 0.0) {
    disk.spin = thermal_spin(scene_, g.spins.temperature, disk.id, inertia, disk.mass, disk.radius);
    disk.spin *= motion.spin_factor;
  }
  return disk;
}

}  // namespace carom
