// How rough the surfaces of disks and walls are: what a contact does along them, where it does anything.
#pragma once

#include <cmath>
#include <cstdint>

namespace carom {

// Of one kind of contact (Walton 1993): sticking contacts multiply the velocity of one surface along the other by
// -restitution; contacts whose impulse would be more than friction times the normal one slide instead.
struct Roughness {
  double restitution = -1.0;   // tangential, in [-1, 1]; -1: smooth, 1: perfectly rough
  double friction = HUGE_VAL;  // Coulomb's, >= 0; infinite: contacts never slide
  bool operator==(const Roughness&) const = default;

  bool acts() const { return restitution > -1.0 && friction > 0.0; }
  // May it lose energy?
  bool dissipates() const { return acts() && (restitution < 1.0 || friction < HUGE_VAL); }
};

// Whose surfaces touch: two disks', fixed ones included, or those of a disk and of a side or an inner wall.
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
