// Sums of doubles without rounding, so that the order in which threads add does not matter.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace carom {

// A fixed-point number wide enough for every finite double (Kulisch accumulator): 32 bits a limb, kept in 64 so that
// 2^31 additions need no carry.
class ExactSum {
 public:
  // Precondition: x is finite.
  void add(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const auto exponent = static_cast<std::size_t>((bits >> 52) & 0x7ffU);
    std::uint64_t mantissa = bits & 0x000fffffffffffffULL;
    if (exponent > 0) mantissa |= 0x0010000000000000ULL;
    const std::size_t place = exponent > 0 ? exponent - 1 : 0;  // of the lowest mantissa bit, in units of 2^-1074
    const std::size_t limb = place / 32;
    const std::size_t shift = place % 32;
    const std::uint64_t low = (mantissa & 0xffffffffU) << shift;
    const std::uint64_t high = (mantissa >> 32) << shift;
    const std::int64_t sign = x < 0.0 ? -1 : 1;
    limbs_[limb] += sign * static_cast<std::int64_t>(low & 0xffffffffU);
    limbs_[limb + 1] += sign * static_cast<std::int64_t>((low >> 32) + (high & 0xffffffffU));
    limbs_[limb + 2] += sign * static_cast<std::int64_t>(high >> 32);
  }

  void add(const ExactSum& other) {
    for (std::size_t k = 0; k < limbs_.size(); ++k) limbs_[k] += other.limbs_[k];
  }

  // The sum as a double: a function of the exact value alone, within one unit in the last place.
  double value() const {
    std::array<std::int64_t, limb_count> carried{};
    std::int64_t carry = 0;
    for (std::size_t k = 0; k < limb_count; ++k) {
      const std::int64_t sum = limbs_[k] + carry;
      carry = sum >> 32;  // rounds down, so every limb below the top is in [0, 2^32)
      carried[k] = sum - carry * 4294967296LL;
    }
    carried[limb_count - 1] += carry * 4294967296LL;
    double total = 0.0;
    for (std::size_t k = limb_count; k-- > 0;) {
      if (carried[k] != 0) total += static_cast<double>(carried[k]) * weight(k);
    }
    return total;
  }

 private:
  static constexpr std::size_t limb_count = 68;

  // 2^(32 k - 1074); a product of two, since the lowest is subnormal.
  static double weight(std::size_t k) {
    const int power = 32 * static_cast<int>(k) - 1074;
    if (power >= -1022 && power <= 1023) return std::bit_cast<double>(static_cast<std::uint64_t>(power + 1023) << 52);
    if (power > 1023) return 0x1p1023 * std::bit_cast<double>(static_cast<std::uint64_t>(power) << 52);
    return 0x1p-1022 * std::bit_cast<double>(static_cast<std::uint64_t>(power + 1022 + 1023) << 52);
  }

  std::array<std::int64_t, limb_count> limbs_{};
};

}  // namespace carom
