// Friction in a collision of rough disks: Walton's rule with three parameters (O. R. Walton in Particulate Two-Phase
// Flow, 1993; Luding, Huthmann, McNamara, Zippelius, Phys. Rev. E 58, 3416, 1998). The normal impulse is that of
// disk_pair.hpp and boundary.hpp; the tangential one comes on top of it, in every method.
#pragma once

#include <cmath>

#include "core/disks/roughness.hpp"
#include "core/physics/disk_pair.hpp"

namespace carom {

// The tangential impulse over the reduced mass; length / time. slip: velocity of one surface along the other before the
// collision; pressed: the normal impulse over the reduced mass, >= 0. inertia: q = I / (m r^2). An impulse k changes
// the slip by k (1 + 1 / q), since it changes the spins too. A sticking contact turns the slip into -restitution slip.
// Coulomb's law bounds the impulse by friction times pressed; at that bound the contact slides.
inline double rub(const Roughness& surface, double inertia, double slip, double pressed) {
  const double sticking = (1.0 + surface.restitution) * (inertia / (1.0 + inertia)) * slip;
  // Infinite friction times no impulse would be no number.
  if (surface.friction == HUGE_VAL) return -sticking;
  const double most = surface.friction * pressed;
  if (sticking > most) return -most;
  return sticking < -most ? most : -sticking;
}

// What friction reads and writes of one disk.
struct RoughDisk {
  double radius;
  double& vx;
  double& vy;
  double& spin;  // angular velocity, counter-clockwise; 1 / time
};

// Disks a and b have just collided; r: their relative motion before, change: what collide() returned. With n from a to
// b and t at a right angle to it, on the left, the slip is dv.t - (r_a w_a + r_b w_b). Momentum is conserved; angular
// momentum too if the centres are r_a + r_b apart.
inline void rub_disks(const Surfaces& surfaces, const Relative& r, Shares share, double change, RoughDisk a,
                      RoughDisk b) {
  const double distance = std::sqrt(r.distance2());
  const double tx = -r.dy / distance;
  const double ty = r.dx / distance;
  const double slip = (r.dvx * tx + r.dvy * ty) - (a.radius * a.spin + b.radius * b.spin);
  const double k = rub(surfaces.disks, surfaces.inertia, slip, change / distance);
  if (k == 0.0) return;  // so that the smooth rule's zeros keep their signs
  const double k1 = k * share.first;
  const double k2 = k * share.second;
  a.vx -= k1 * tx;
  a.vy -= k1 * ty;
  b.vx += k2 * tx;
  b.vy += k2 * ty;
  a.spin -= k1 / (surfaces.inertia * a.radius);
  b.spin -= k2 / (surfaces.inertia * b.radius);
}

// Disk a has just bounced off a wall or an obstacle, whose surface does not move along itself. n: unit vector from it
// towards the disk. pressed: the change of the disk's velocity along n, >= 0.
inline void rub_wall(const Roughness& surface, double inertia, Vec2 n, double pressed, RoughDisk a) {
  const double slip = (a.vy * n.x - a.vx * n.y) - a.radius * a.spin;
  const double k = rub(surface, inertia, slip, pressed);
  if (k == 0.0) return;
  a.vx -= k * n.y;
  a.vy += k * n.x;
  a.spin -= k / (inertia * a.radius);
}

// Energy of rotation; mass length^2 / time^2.
inline double rotational_energy(double inertia, double mass, double radius, double spin) {
  const double surface_speed = radius * spin;
  return 0.5 * (inertia * mass) * (surface_speed * surface_speed);
}

}  // namespace carom
