// Roughness of the surfaces of disks and walls: the parameters of friction in a collision.
#pragma once

#include <cmath>
#include <cstdint>

namespace carom {

// For one kind of contact (Walton 1993): a sticking contact multiplies the slip velocity by -restitution; a contact
// whose tangential impulse would exceed friction times the normal one slides instead.
struct Roughness {
  double restitution = -1.0;   // tangential, in [-1, 1]; -1: smooth, 1: perfectly rough
  double friction = HUGE_VAL;  // Coulomb's, >= 0; infinite: contacts never slide
  bool operator==(const Roughness&) const = default;

  bool acts() const { return restitution > -1.0 && friction > 0.0; }
  // May it lose energy?
  bool dissipates() const { return acts() && (restitution < 1.0 || friction < HUGE_VAL); }
};

// The kind of contact: two disks (one may be fixed), or a disk and a side or an inner wall.
enum class Touching : std::uint8_t { disks, wall };

// The surfaces of a scene.
struct Surfaces {
  double inertia = 0.0;  // moment of inertia of a disk over m r^2, in (0, 1]; 0: disks are smooth and have no spin
  Roughness disks;       // of Touching::disks
  Roughness walls;       // of Touching::wall
  bool operator==(const Surfaces&) const = default;

  const Roughness& of(Touching which) const { return which == Touching::disks ? disks : walls; }
  bool are_rough() const { return inertia > 0.0; }
  bool dissipate() const { return are_rough() && (disks.dissipates() || walls.dissipates()); }
};

}  // namespace carom
