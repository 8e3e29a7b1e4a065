// Giving the disks of a scene their first velocities.
#pragma once

#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Sets vx and vy of all disks, entry i having id i, by the law of the group of each. maxwell: normal deviates with
// variance T / m a component, then the group's mean velocity (weighted by mass) is taken off and the rest scaled, so
// that the kinetic energy is count * T (two degrees of freedom a disk, k_B = 1) to rounding. Sums run in id order. The
// group's drift is added last.
// Precondition: radius and mass are known. Throws InputError for velocities that are not finite.
void set_velocities(const Scene& scene, Disks& disks);

// Where disks are rough: gives them their moments of inertia and first spins, likewise by the law of the group of each.
void set_spins(const Scene& scene, Disks& disks);

// What they draw for a disk, before the sums over its group.
Vec2 maxwell_velocity(const Scene& scene, double temperature, DiskId id, double mass);
Vec2 uniform_velocity(const Scene& scene, double limit, DiskId id);
double thermal_spin(const Scene& scene, double temperature, DiskId id, double inertia, double mass, double radius);

// The sums over a group that take off its mean velocity; its disks in order of id.
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
