// A sum whose bits do not depend on the order of its terms, so that any number of threads may add to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom {

// Terms are cut to whole multiples of a unit that is a power of two and added as integers, which is associative. The
// unit is 2^-60 of a scale that both engines know before the first term, so a sum is good to 1e-18 of that scale, and
// scaling all input by a power of two scales it exactly. Terms may exceed the scale by 2^60; beyond that they saturate.
class OrderFreeSum {
 public:
  // scale > 0 and finite: about the largest term; 0 where all terms are 0.
  explicit OrderFreeSum(double scale = 0.0) {
    if (!(scale > 0.0) || !std::isfinite(scale)) return;
    int exponent = 0;
    std::frexp(scale, &exponent);
    const int shift = std::clamp(60 - exponent, -1000, 1000);
    units_per_one_ = std::ldexp(1.0, shift);
    unit_ = std::ldexp(1.0, -shift);
  }

  void add(double term) {
    const double units = std::clamp(term * units_per_one_, -0x1p120, 0x1p120);
    // Most terms fit in a machine integer, whose conversion is much faster.
    units_ += std::abs(units) < 0x1p62 ? static_cast<std::int64_t>(units) : static_cast<Integer>(units);
  }
  // Precondition: the same scale.
  void add(const OrderFreeSum& other) { units_ += other.units_; }

  double value() const { return static_cast<double>(units_) * unit_; }

 private:
  __extension__ using Integer = __int128;
  Integer units_ = 0;
  double units_per_one_ = 1.0;  // powers of two
  double unit_ = 1.0;
};

}  // namespace carom
