// Sums of doubles without rounding, so that the order in which threads add does not matter.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace carom {

// A fixed-point number wide enough for every finite double (Kulisch accumulator): 32 bits a limb, kept in 64. An
// addition changes one by less than 1.5 2^32, so that 2^30 of them need no carry.
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

  // Adds all of them, several times faster than one by one where most are within a factor of 2^36. Precondition:
  // finite.
  void add(std::span<const double> values);
  // The same where their largest magnitude is known. Precondition: at most `block` values.
  void add(std::span<const double> values, double largest);
  static constexpr std::size_t block = 256;

  void add(const ExactSum& other) {
    for (std::size_t k = 0; k < limbs_.size(); ++k) limbs_[k] += other.limbs_[k];
  }

  // The digits of the number. Digits of several sums, added up place by place, are the digits of their sum.
  std::span<std::int64_t> digits() { return limbs_; }

  // The sum, rounded once, correctly; so it scales exactly with powers of two.
  double value() const {
    std::array<std::int64_t, limb_count> digits = limbs_;
    const bool negative = carry_over(digits) < 0;
    if (negative) {
      for (std::int64_t& digit : digits) digit = -digit;
      carry_over(digits);
    }
    std::size_t top = limb_count - 1;
    while (top > 2 && digits[top] == 0) --top;
    // At least 65 bits from the leading one on; the lowest of them is set if anything but zeros follows.
    Wide leading = 0;
    for (std::size_t k = 0; k < 3; ++k) leading = (leading << 32) + static_cast<Wide>(digits[top - k]);
    const auto below = digits.begin() + static_cast<std::ptrdiff_t>(top - 2);
    if (std::any_of(digits.begin(), below, [](std::int64_t digit) { return digit != 0; })) leading |= 1U;
    const double size = std::ldexp(static_cast<double>(leading), 32 * static_cast<int>(top - 2) - 1074);
    return negative ? -size : size;
  }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr std::size_t limb_count = 68;

  // Brings all limbs but the last into [0, 2^32); returns the last, which has the sign of the whole.
  static std::int64_t carry_over(std::array<std::int64_t, limb_count>& digits) {
    for (std::size_t k = 0; k + 1 < limb_count; ++k) {
      const std::int64_t carry = digits[k] >> 32;  // rounds down
      digits[k] -= carry * 4294967296LL;
      digits[k + 1] += carry;
    }
    return digits.back();
  }

  std::array<std::int64_t, limb_count> limbs_{};
};

// The largest magnitude among the values; 0 if there are none.
double largest_size(std::span<const double> values);

}  // namespace carom
