// Coordinates as whole numbers: one axis of the box, cut into equal steps.
#pragma once

#include <cmath>
#include <cstdint>

namespace carom {

// The axis [0, length] in steps of quantum(). Between periodic sides there are 2^bits steps, and numbers wrap like
// coordinates, by arithmetic modulo 2^bits; otherwise the last number stands for `length` itself.
struct ViewAxis {
  double length = 1.0;  // length, > 0
  bool periodic = false;
  unsigned bits = 16;  // 16 to 24

  std::uint32_t mask() const { return (std::uint32_t{1} << bits) - 1U; }
  double quantum() const { return length / (static_cast<double>(mask()) + (periodic ? 1.0 : 0.0)); }

  // The number nearest to x. For a centre outside the box it is that of its image across a periodic side, or else of
  // the edge. A value that is not a number becomes 0.
  std::uint32_t encode(double x) const {
    const double step = x * (1.0 / quantum()) + 0.5;
    if (step >= 0.0 && step < static_cast<double>(mask()) + 1.0) {
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(step));
    }
    return encode_outside(std::floor(step));
  }
  double decode(std::uint32_t number) const { return number * quantum(); }

 private:
  std::uint32_t encode_outside(double step) const {
    if (!std::isfinite(step)) return 0;
    const double steps = static_cast<double>(mask()) + 1.0;
    if (periodic) return static_cast<std::uint32_t>(step - steps * std::floor(step / steps)) & mask();
    return step < 0.0 ? 0U : mask();
  }
};

// The fewest bits, but at least 16, with which a step is at most a 64th of the smallest radius; at most 24, the
// precision of the graphics' single precision numbers.
inline ViewAxis view_axis(double length, bool periodic, double smallest_radius) {
  ViewAxis axis{length, periodic, 16};
  while (axis.bits < 24 && 64.0 * axis.quantum() > smallest_radius) ++axis.bits;
  return axis;
}

}  // namespace carom
