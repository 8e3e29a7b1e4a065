#include "io/trajectory/shortest_decimal.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/base/kernel_set.hpp"
#include "io/trajectory/decimal_batch.hpp"
#include "io/trajectory/decimal_scale.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace carom {

namespace {

template <class Number>
char* write_by_library(char* out, Number value) {
  return std::to_chars(out, out + shortest_decimal_bytes, value).ptr;
}

#if defined(__SSE2__)

__extension__ using Wide = unsigned __int128;

// Makes the 7 to 9 digits of a float 15 to 17.
template <class Number>
constexpr std::uint64_t lift = 1;
template <>
constexpr std::uint64_t lift<float> = 100'000'000;

template <class Number>
constexpr std::array<Binade, binades> make_binades() {
  std::array<Binade, binades> all{};
  for (int j = 0; j < binades; ++j) all[static_cast<std::size_t>(j)] = make_binade<Number>(first_binade + j);
  return all;
}

template <class Number>
inline constexpr std::array<Binade, binades> all_binades = make_binades<Number>();

// All bits are set if the condition holds. A choice by masks takes no branch, which would be mispredicted half the
// time.
constexpr std::uint64_t mask(bool condition) {
  return -static_cast<std::uint64_t>(condition);
}

// The shortest decimal that is read as c * 2^q, in units of 10^k: the multiple of ten that is nearer to c * 2^q than to
// its neighbours (c - 1) * 2^q and (c + 1) * 2^q. There is at most one. If there is none, the nearest whole number, and
// the even one of two. Powers of two have a nearer lower neighbour; those of these binades have so few digits that it
// makes no difference.
std::uint64_t shortest(std::uint64_t c, const Binade& binade) {
  const int s = binade.shift;
  const Wide product = Wide{c} * binade.five;
  const auto low = static_cast<std::uint64_t>(product);
  const std::uint64_t one = std::uint64_t{1} << s;
  const auto whole = static_cast<std::uint64_t>(product >> s);
  const std::uint64_t tens = whole - whole % 10;
  // Twice the distances to the two multiples of ten around the number. They are even and a unit of 2^q, binade.five, is
  // odd, so that they are never equal to it.
  const std::uint64_t below = 2 * (low - (tens << s)), above = 20 * one - below;
  const std::uint64_t down = mask(below < binade.five), up = mask(above < binade.five);
  const std::uint64_t nearest = whole + ((2 * (low & (one - 1)) + one - 1 + (whole & 1)) >> s >> 1);
  return (nearest & ~(down | up)) | ((tens + (up & 10)) & (down | up));
}

// The digits of a number below 10^16, a byte each, the first digit first.
__m128i sixteen_digits(std::uint64_t number) {
  const std::uint64_t upper = number / 100'000'000;
  const __m128i eights =
      _mm_set_epi64x(static_cast<long long>(number - upper * 100'000'000), static_cast<long long>(upper));
  // A division is a product with a rounded reciprocal and a shift. The remainder is put behind the quotient.
  __m128i part = _mm_srli_epi64(_mm_mul_epu32(eights, _mm_set1_epi64x(3'518'437'209)), 45);  // / 10^4
  const __m128i fours =
      _mm_or_si128(part, _mm_slli_epi64(_mm_sub_epi64(eights, _mm_mul_epu32(part, _mm_set1_epi64x(10'000))), 32));
  part = _mm_srli_epi16(_mm_mulhi_epu16(fours, _mm_set1_epi16(5243)), 3);  // / 100
  const __m128i twos =
      _mm_or_si128(part, _mm_slli_epi32(_mm_sub_epi16(fours, _mm_mullo_epi16(part, _mm_set1_epi16(100))), 16));
  part = _mm_mulhi_epu16(twos, _mm_set1_epi16(6554));  // / 10
  return _mm_or_si128(part, _mm_slli_epi16(_mm_sub_epi16(twos, _mm_mullo_epi16(part, _mm_set1_epi16(10))), 8));
}

// The shortest decimal of a number, d.ddd * 10^exponent, as text.
struct Decimal {
  std::uint64_t front;  // the first eight digits
  __m128i others;       // the sixteen digits behind the first
  int digits;           // up to the last that is not 0
  int exponent;
};

template <class Number>
Decimal decimal_of(std::uint64_t c, const Binade& binade) {
  constexpr std::uint64_t ten_to_16 = 10'000'000'000'000'000;
  constexpr bool is_lifted = (lift<Number>) > 1;
  std::uint64_t number = shortest(c, binade) * lift<Number>;
  int exponent = binade.unit + (is_lifted ? 8 : 16);
  for (int least_digits = is_lifted ? 15 : 16; least_digits < 17; ++least_digits) {
    const bool lacks_one = number < ten_to_16;
    number += mask(lacks_one) & (9 * number);
    exponent -= static_cast<int>(lacks_one);
  }
  const std::uint64_t first = number / ten_to_16;
  const __m128i digits = sixteen_digits(number - first * ten_to_16);
  const auto zeros = static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(digits, _mm_setzero_si128())));
  const __m128i others = _mm_or_si128(digits, _mm_set1_epi8('0'));
  const std::uint64_t front = (first + '0') | (static_cast<std::uint64_t>(_mm_cvtsi128_si64(others)) << 8);
  return {front, others, static_cast<int>(std::bit_width(((~zeros & 0xffffU) << 1) | 1U)), exponent};
}

// How the first eight characters of a number of this exponent are made of its first eight digits.
struct Point {
  std::uint64_t before, text, after;  // masks of the digits before and after the point, and the text between them
  int shift;                          // of the digits after it, in bits
  int zeros;                          // before the first digit
};

constexpr std::uint64_t first_bytes(int count) {
  return count == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << 8 * count) - 1;
}

constexpr std::array<Point, exponents> make_points() {
  std::array<Point, exponents> all{};
  for (int j = 0; j < exponents; ++j) {
    const int e = first_exponent + j;
    Point& point = all[static_cast<std::size_t>(j)];
    if (e < 0) point = {0, 0x3030'3030'2e30 & first_bytes(1 - e), first_bytes(8), 8 * (1 - e), -e};  // 0.0000
    if (e >= 0) point = {first_bytes(e + 1), std::uint64_t{'.'} << 8 * (e + 1), ~first_bytes(e + 2), 8, 0};
  }
  return all;
}

constexpr std::array<Point, exponents> all_points = make_points();

// False if the text with an exponent is shorter, as 1e-04 and 3e+05, or if make_points() has no row for the exponent.
bool can_have_point(const Decimal& decimal) {
  const bool is_long = decimal.digits > 1 || (decimal.exponent > first_exponent && decimal.exponent < 5);
  return is_long && static_cast<unsigned>(decimal.exponent - first_exponent) < exponents;
}

char* write_with_point(char* out, bool negative, const Decimal& decimal) {
  *out = '-';
  out += static_cast<int>(negative);
  const Point& point = all_points[static_cast<unsigned>(decimal.exponent - first_exponent)];
  const std::uint64_t front =
      (decimal.front & point.before) | point.text | ((decimal.front << point.shift) & point.after);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out + point.zeros + 2), decimal.others);
  std::memcpy(out, &front, sizeof front);
  const int whole_digits = decimal.exponent + 1;
  return out + (decimal.digits <= whole_digits ? whole_digits : decimal.digits + 1 + point.zeros);
}

template <class Number>
char* write(char* out, Number value) {
  using P = BinaryFormat<Number>;
  constexpr typename P::Bits one = 1;
  const auto bits = std::bit_cast<typename P::Bits>(value);
  const auto biased = static_cast<unsigned>((bits >> P::fraction_bits) & ((one << P::exponent_bits) - 1));
  const unsigned j = biased - static_cast<unsigned>(first_binade + (1 << (P::exponent_bits - 1)) - 1);
  if (j >= binades) return write_by_library(out, value);
  const std::uint64_t c = (bits & ((one << P::fraction_bits) - 1)) | (one << P::fraction_bits);
  const Decimal decimal = decimal_of<Number>(c, all_binades<Number>[j]);
  if (!can_have_point(decimal)) return write_by_library(out, value);
  return write_with_point(out, (bits >> (P::fraction_bits + P::exponent_bits)) != 0, decimal);
}

// A number whose digits were found with those of others.
template <class Number>
char* write(char* out, const DecimalBatch<Number>& batch, std::size_t k) {
  const auto& [exponent, zeros] = batch.scales[k];
  const char* const text = batch.texts[k].data() + DecimalBatch<Number>::digits_at - zeros;
  Decimal decimal{0, _mm_loadu_si128(reinterpret_cast<const __m128i*>(text + 1)),
                  static_cast<int>(std::bit_width(unsigned{batch.nonzero[k]})) + 1 + zeros,
                  static_cast<int>(exponent) + first_exponent};
  std::memcpy(&decimal.front, text, sizeof decimal.front);
  if (!can_have_point(decimal)) return write_shortest(out, batch.numbers[k]);
  return write_with_point(out, std::signbit(batch.numbers[k]), decimal);
}

#else

template <class Number>
char* write(char* out, Number value) {
  return write_by_library(out, value);
}

template <class Number>
char* write(char* out, const DecimalBatch<Number>& batch, std::size_t k) {
  return write_by_library(out, batch.numbers[k]);
}

#endif

template <class Number>
void convert_baseline(DecimalBatch<Number>& batch) {
  for (auto& scale : batch.scales) scale = {DecimalBatch<Number>::unconverted, 0};
}

}  // namespace

char* write_shortest(char* out, double value) {
  return write(out, value);
}

char* write_shortest(char* out, float value) {
  return write(out, value);
}

template <class Number>
DecimalKernel<Number> choose_decimal_kernel() {
  if (kernel_set() == KernelSet::avx2) return convert_avx2;
  return convert_baseline<Number>;
}
template DecimalKernel<double> choose_decimal_kernel();
template DecimalKernel<float> choose_decimal_kernel();

char* write_decimal(char* out, const DecimalBatch<double>& batch, std::size_t k) {
  return write(out, batch, k);
}

char* write_decimal(char* out, const DecimalBatch<float>& batch, std::size_t k) {
  return write(out, batch, k);
}

}  // namespace carom
