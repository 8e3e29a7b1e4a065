// Gravity: the acceleration that all disks share.
#pragma once

#include <cmath>

namespace carom {

// The vector (-left, -down); length / time^2. Components are stored as those of a fall to the left and down and are
// subtracted, so that a component 0 changes no bit of a velocity, not even the sign of a zero.
struct Gravity {
  double left = 0.0;
  double down = 0.0;
  double size = 0.0;  // of the vector
  bool tilted = false;

  // A number is gravity downwards, as in a scene.
  constexpr Gravity(double g = 0.0) : down(g), size(g < 0.0 ? -g : g) {}  // NOLINT(google-explicit-constructor)
  Gravity(double to_the_left, double downwards)
      : left(to_the_left),
        down(downwards),
        size(size_of(std::abs(to_the_left), std::abs(downwards))),
        tilted(to_the_left != 0.0) {}
  bool operator==(const Gravity&) const = default;

  constexpr bool acts() const { return size > 0.0; }
  // Does it change velocities along x?
  constexpr bool is_tilted() const { return tilted; }
  // Its component against the unit vector (nx, ny). If that is the normal of a wall, towards the disk, this
  // acceleration presses the disk on the wall; times a mass and a distance it is the work of a lift.
  constexpr double against(double nx, double ny) const { return down * ny + left * nx; }

 private:
  // The length of (a, b): exact if one of them is 0, without overflow or underflow on the way.
  static double size_of(double a, double b) {
    const double larger = a > b ? a : b;
    if (larger == 0.0) return 0.0;
    const double ratio = (a > b ? b : a) / larger;
    return larger * std::sqrt(1.0 + ratio * ratio);
  }
};

}  // namespace carom
