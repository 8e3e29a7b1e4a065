// Are two numbers the same, as what is computed twice has to be?
#pragma once

#include <bit>
#include <cstdint>

namespace carom {

// 0 and -0 are not; a NaN and itself are.
inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace carom
