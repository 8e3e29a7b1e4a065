// What a collision does along the surfaces of rough disks: Walton's rule with three parameters (O. R. Walton in
// Particulate Two-Phase Flow, 1993; Luding, Huthmann, McNamara, Zippelius, Phys. Rev. E 58, 3416, 1998).
// The normal impulse is that of disk_pair.hpp and boundary.hpp; what stands here comes on top of it, in every method.
#pragma once

#include <cmath>

#include "core/disks/roughness.hpp"
#include "core/physics/disk_pair.hpp"

namespace carom {

// The tangential impulse over the reduced mass; length / time. slip: velocity of one surface along the other before
// the collision; pressed: the normal impulse over the reduced mass, >= 0. inertia: I / (m r^2), q. A change k of the
// relative velocity changes the slip by k (1 + 1 / q), since both surfaces give way: sticking, it is to become
// -restitution slip. Coulomb's law bounds it by friction pressed; then the contact slides.
inline double rub(const Roughness& surface, double inertia, double slip, double pressed) {
  const double sticking = (1.0 + surface.restitution) * (inertia / (1.0 + inertia)) * slip;
  // Infinite friction times no impulse would be no number.
  if (surface.friction == HUGE_VAL) return -sticking;
  const double most = surface.friction * pressed;
  if (sticking > most) return -most;
  return sticking < -most ? most : -sticking;
}

// Two disks, of radii r1 and r2 and angular velocities w1 and w2 (counter-clockwise), have just collided (collide,
// which returned `change`); r is how they met. With n from the first to the second and t at a right angle to it, on the
// left, the slip is dv.t - (r1 w1 + r2 w2). Momentum stays, and angular momentum where the centres are r1 + r2 apart.
inline void rub_disks(const Surfaces& surfaces, const Relative& r, Shares share, double change, double r1, double r2,
                      double& vx1, double& vy1, double& vx2, double& vy2, double& w1, double& w2) {
  const double distance = std::sqrt(r.distance2());
  const double tx = -r.dy / distance;
  const double ty = r.dx / distance;
  const double slip = (r.dvx * tx + r.dvy * ty) - (r1 * w1 + r2 * w2);
  const double k = rub(surfaces.disks, surfaces.inertia, slip, change / distance);
  if (k == 0.0) return;  // so that the smooth rule's zeros keep their signs
  const double k1 = k * share.first;
  const double k2 = k * share.second;
  vx1 -= k1 * tx;
  vy1 -= k1 * ty;
  vx2 += k2 * tx;
  vy2 += k2 * ty;
  w1 -= k1 / (surfaces.inertia * r1);
  w2 -= k2 / (surfaces.inertia * r2);
}

// A disk of radius r has just bounced off what does not move along its surface: a wall, or an obstacle, of which
// n is the unit vector towards the disk. pressed: by how much that has changed its velocity, >= 0.
inline void rub_wall(const Roughness& surface, double inertia, Vec2 n, double r, double pressed, double& vx, double& vy,
                     double& w) {
  const double slip = (vy * n.x - vx * n.y) - r * w;
  const double k = rub(surface, inertia, slip, pressed);
  if (k == 0.0) return;
  vx -= k * n.y;
  vy += k * n.x;
  w -= k / (inertia * r);
}

// Energy of rotation; mass length^2 / time^2.
inline double rotational_energy(double inertia, double mass, double radius, double spin) {
  const double surface_speed = radius * spin;
  return 0.5 * (inertia * mass) * (surface_speed * surface_speed);
}

}  // namespace carom
