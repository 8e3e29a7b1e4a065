// The acceleration that all disks have in common.
#pragma once

#include <cmath>

namespace carom {

// Gravity (-left, -down), in length / time^2: kept with the signs of a fall to the left and down, so that a component
// that is 0 changes no bit of what it is taken from, not the sign of a zero either.
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
  // Its part against the unit vector (nx, ny): what holds a disk down on a wall whose normal, towards the disk, that
  // is. Times a mass and a distance, the work of a lift.
  constexpr double against(double nx, double ny) const { return down * ny + left * nx; }

 private:
  // Exact where one of them is 0; neither overflows nor underflows before the size does.
  static double size_of(double a, double b) {
    const double larger = a > b ? a : b;
    if (larger == 0.0) return 0.0;
    const double ratio = (a > b ? b : a) / larger;
    return larger * std::sqrt(1.0 + ratio * ratio);
  }
};

}  // namespace carom
