// Lees-Edwards boundary: a shear flow vx = rate (y - height / 2) through periodic sides. The images above the box are
// displaced along x and move.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace carom {

struct Shear {
  double rate = 0.0;    // dvx / dy of the flow; 1 / time, 0: none
  double jump = 0.0;    // velocity of the images above, rate times the height of the box; length / time
  double offset = 0.0;  // displacement of the images above at the time that the box is used for; at most half a width

  // Compares bits, which is one comparison less than with doubles. The rate is never -0.
  bool acts() const { return std::bit_cast<std::uint64_t>(rate) != 0; }

  // The offset at time t. remainder() is exact in IEEE arithmetic, so the offset stays accurate however many widths the
  // images have moved.
  double offset_at(double t, double width) const { return jump * std::remainder(t, width / std::abs(jump)); }

  // Replaces a disk of this mass by its image `rows` boxes above (a whole number): changes its vx, and returns the
  // energy that it gains, the work of the shear.
  double jump_rows(double mass, double& vx, double rows) const {
    if (rows == 0.0) return 0.0;
    const double change = rows * jump;
    const double work = mass * change * (vx + 0.5 * change);
    vx += change;
    return work;
  }

  // Velocity of the flow at height y; length / time.
  double flow(double y, double height) const { return rate * (y - 0.5 * height); }
};

}  // namespace carom
