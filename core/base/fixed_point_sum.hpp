// Sums of terms of a known size that do not depend on their order, so that threads and ranks may share them out. Of any
// terms, and without a rounding, in 34 times the memory: exact_sum.hpp.
#pragma once

#include <cstdint>

namespace carom {

// In units of 2^-40: high * 2^20 + low. Sums of many may be added number by number.
struct FixedPointSum {
  std::int64_t high = 0, low = 0;
};

// A term, cut off to a multiple of 2^-40. Precondition: its magnitude is at most 2. At most 2^41 terms may be added up.
inline FixedPointSum fixed_point(double term) {
  constexpr int low_bits = 20;
  const auto units = static_cast<std::int64_t>(term * 0x1p40);
  return {units >> low_bits, units & ((std::int64_t{1} << low_bits) - 1)};
}

inline FixedPointSum& operator+=(FixedPointSum& sum, const FixedPointSum& other) {
  sum.high += other.high;
  sum.low += other.low;
  return sum;
}

inline double value_of(const FixedPointSum& sum) {
  return static_cast<double>(sum.high) * 0x1p-20 + static_cast<double>(sum.low) * 0x1p-40;
}

}  // namespace carom
