// The scale of binary numbers in decimals: what a conversion needs to know of each power of two.
#pragma once

#include <cstdint>

namespace carom {

// The format of a number c * 2^q, where c is a whole number of fraction_bits + 1 bits.
template <class Number>
struct BinaryFormat;

template <>
struct BinaryFormat<double> {
  using Bits = std::uint64_t;
  static constexpr int fraction_bits = 52, exponent_bits = 11;
};

template <>
struct BinaryFormat<float> {
  using Bits = std::uint32_t;
  static constexpr int fraction_bits = 23, exponent_bits = 8;
};

// All numbers in [2^b, 2^(b+1)). Let 10^k be the largest power of ten with 10^k <= 2^q. Then c * 2^q is c * five /
// 2^shift in units of 10^k, where five = 5^-k has at most 47 bits, so that the product is exact.
struct Binade {
  std::uint64_t five;
  int shift;
  int unit;  // k
};

constexpr int first_binade = -14, binades = 38;  // from below 1e-4 to beyond 1e7

template <class Number>
constexpr Binade make_binade(int b) {
  const int q = b - BinaryFormat<Number>::fraction_bits;
  const int k = (q * 1'262'611) >> 22;  // log10(2) * q, rounded down
  std::uint64_t five = 1;
  for (int i = k; i < 0; ++i) five *= 5;
  return {five, k - q, k};
}

// Texts with a decimal point are written for numbers d.ddd * 10^e, where e is one of `exponents` from this one on.
constexpr int first_exponent = -4, exponents = 11;

}  // namespace carom
