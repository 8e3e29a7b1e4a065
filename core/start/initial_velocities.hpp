// The initial velocities and spins of the disks of a scene.
#pragma once

#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Sets vx and vy of all disks (entry i has id i) by the law of each group. maxwell: components are normal deviates of
// variance T / m; then the velocity of the group's centre of mass is subtracted and the rest scaled, so that the
// kinetic energy is count * T (two degrees of freedom, k_B = 1) to rounding. Sums run in order of id. The group's drift
// is added last. Precondition: radius and mass are known. Throws InputError for velocities that are not finite.
void set_velocities(const Scene& scene, Disks& disks);

// For rough disks: sets their moment of inertia and their initial spins, by the law of each group.
void set_spins(const Scene& scene, Disks& disks);

// The velocity drawn for a disk, before the corrections by sums over its group.
Vec2 maxwell_velocity(const Scene& scene, double temperature, DiskId id, double mass);
Vec2 uniform_velocity(const Scene& scene, double limit, DiskId id);
double thermal_spin(const Scene& scene, double temperature, DiskId id, double inertia, double mass, double radius);

// The sums over a group by which its mean velocity is subtracted; disks are added in order of id.
struct GroupMomentum {
  double mass = 0.0, px = 0.0, py = 0.0;
  void add(double m, Vec2 v) {
    mass += m;
    px += m * v.x;
    py += m * v.y;
  }
  Vec2 mean_velocity() const { return {px / mass, py / mass}; }
};

}  // namespace carom
