// Equality of doubles bit by bit, as a number has to be that is computed in two ways.
#pragma once

#include <bit>
#include <cstdint>

namespace carom {

// Unlike ==: 0 and -0 differ, and a NaN equals itself.
inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace carom
