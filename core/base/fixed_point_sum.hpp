// Sums of terms of a bounded size that do not depend on the order of the terms, so that threads and ranks may share
// them out. For terms of any size, without rounding, and in 34 times the memory, there is exact_sum.hpp.
#pragma once

#include <cstdint>

namespace carom {

// high * 2^20 + low, in units of 2^-40. Two sums are added by adding their members one by one.
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
