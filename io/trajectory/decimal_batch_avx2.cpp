// Compiled with -mavx2 on x86-64 (CMakeLists.txt); nothing calls it elsewhere.
#include "io/trajectory/decimal_batch.hpp"

#if defined(__AVX2__)

#include <immintrin.h>

#include "io/trajectory/decimal_scale.hpp"

namespace carom {

namespace {

constexpr std::size_t lanes = 4;
constexpr std::size_t size = DecimalBatch<double>::size;
template <class Number>
constexpr bool is_double = sizeof(Number) == sizeof(double);
constexpr std::uint64_t ten_to_8 = 100'000'000;

inline __m256i all(std::uint64_t a) {
  return _mm256_set1_epi64x(static_cast<long long>(a));
}
constexpr std::uint64_t first_bits(int count) {
  return (std::uint64_t{1} << count) - 1;
}

// Binades in one word each: `five`, the exponent of ten of the first of seventeen digits (nine of a float), counted
// from first_exponent, and the shift for twice the number. Behind the last binade comes one for all other numbers.
constexpr int exponent_at = 47, shift_at = 58;

template <class Number>
constexpr std::array<std::uint64_t, binades + 1> make_words() {
  constexpr int last_digit = is_double<Number> ? 16 : 8;
  std::array<std::uint64_t, binades + 1> words{};
  for (int j = 0; j < binades; ++j) {
    const Binade binade = make_binade<Number>(first_binade + j);
    const auto exponent = static_cast<std::uint64_t>(binade.unit + last_digit - first_exponent);
    words[static_cast<std::size_t>(j)] =
        binade.five | exponent << exponent_at | static_cast<std::uint64_t>(binade.shift + 1) << shift_at;
  }
  words[binades] = std::uint64_t{DecimalBatch<Number>::unconverted} << exponent_at;
  return words;
}

template <class Number>
constexpr std::array<std::uint64_t, binades + 1> all_words = make_words<Number>();

inline __m256i five_of(__m256i word) {
  return _mm256_and_si256(word, all(first_bits(exponent_at)));
}
inline __m256i shift_of(__m256i word) {
  return _mm256_srli_epi64(word, shift_at);
}

// A conversion is a chain of some hundred operations, too long for the processor to begin the next one before the end
// of the last. So it is cut into three, with these numbers between them, and each part is done for the whole batch. Of
// four numbers the second and the third are exchanged, as the last part finds the digits of two times two.
struct alignas(32) Work {
  std::array<std::uint64_t, size> word;
  std::array<std::uint64_t, size> whole, rest;    // of 2 c * five / 2^shift
  std::array<std::uint64_t, size> eight, others;  // digits 1 to 8 and 9 to 16
};

inline __m256i load(const std::uint64_t* from) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
}
inline void store(std::uint64_t* to, __m256i value) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(to), value);
}

inline __m256i bits_of(const double* numbers) {
  return _mm256_castpd_si256(_mm256_load_pd(numbers));
}
inline __m256i bits_of(const float* numbers) {
  return _mm256_castpd_si256(_mm256_cvtps_pd(_mm_load_ps(numbers)));
}

// The words of the binades of four numbers, by the exponents in their bits.
template <class Number>
__m256i words_of(__m256i twice_bits) {
  const __m256i biased = _mm256_srli_epi64(twice_bits, 53);
  const __m256i j = _mm256_min_epu32(_mm256_sub_epi32(biased, all(1023 + first_binade)), all(binades));
  const __m128i low = _mm256_castsi256_si128(j), high = _mm256_extracti128_si256(j, 1);
  const auto word = [](int row) { return static_cast<long long>(all_words<Number>[static_cast<unsigned>(row)]); };
  return _mm256_set_epi64x(word(_mm_extract_epi32(high, 2)), word(_mm_cvtsi128_si32(high)),
                           word(_mm_extract_epi32(low, 2)), word(_mm_cvtsi128_si32(low)));
}

// The product of c, of 54 bits, and five, of 47.
struct Product {
  __m256i high, low;
};

inline Product product_of(__m256i c, __m256i five) {
  const __m256i c_high = _mm256_srli_epi64(c, 32), five_high = _mm256_srli_epi64(five, 32);
  const __m256i low = _mm256_mul_epu32(c, five);
  const __m256i middle = _mm256_add_epi64(
      _mm256_add_epi64(_mm256_mul_epu32(c, five_high), _mm256_mul_epu32(c_high, five)), _mm256_srli_epi64(low, 32));
  return {_mm256_add_epi64(_mm256_mul_epu32(c_high, five_high), _mm256_srli_epi64(middle, 32)),
          _mm256_blend_epi32(low, _mm256_slli_epi64(middle, 32), 0b10101010)};
}

// 2 c, from twice the bits of a double, which leave out the first bit of c.
template <class Number>
__m256i twice_c(__m256i twice_bits) {
  constexpr int bits = BinaryFormat<Number>::fraction_bits + 1;
  const __m256i fraction = _mm256_and_si256(_mm256_srli_epi64(twice_bits, 53 - bits), all(first_bits(bits)));
  return _mm256_or_si256(fraction, all(std::uint64_t{1} << bits));
}

// First part: four numbers in units of 10^k.
template <class Number>
void scale(const Number* numbers, Work& work, std::size_t at) {
  const __m256i bits = _mm256_permute4x64_epi64(bits_of(numbers), 0b11011000);
  const __m256i twice_bits = _mm256_add_epi64(bits, bits);
  const __m256i word = words_of<Number>(twice_bits), shift = shift_of(word), c = twice_c<Number>(twice_bits);
  store(&work.word[at], word);
  Product product{all(0), _mm256_mul_epu32(c, five_of(word))};
  if constexpr (is_double<Number>) product = product_of(c, five_of(word));
  const __m256i whole = _mm256_srlv_epi64(product.low, shift);
  store(&work.whole[at], _mm256_or_si256(whole, _mm256_sllv_epi64(product.high, _mm256_sub_epi64(all(64), shift))));
  store(&work.rest[at], _mm256_andnot_si256(_mm256_sllv_epi64(all(~std::uint64_t{0}), shift), product.low));
}

// whole / 10^8, rounded down, for numbers below 10^17: 10^8 is 2^8 * 390625. A whole number below 2^52 becomes a double
// if it is written into the fraction of 2^52. One half is added to it before it is divided and taken away from the
// quotient, so that the sum is rounded down and never at a tie. Of 0, which an unconverted number has here, the result
// is of no use, and not used.
inline __m256i by_ten_to_8(__m256i whole) {
  const __m256i unit = _mm256_castpd_si256(_mm256_set1_pd(4503599627370496.0));  // 2^52
  const __m256d less_half = _mm256_set1_pd(4503599627370495.5);
  const __m256d number = _mm256_castsi256_pd(_mm256_or_si256(_mm256_srli_epi64(whole, 8), unit));
  const __m256d quotient = _mm256_mul_pd(_mm256_sub_pd(number, less_half), _mm256_set1_pd(1.0 / 390625));
  return _mm256_xor_si256(_mm256_castpd_si256(_mm256_add_pd(quotient, less_half)), unit);
}

// The shortest decimal that is read as the number (shortest_decimal.cpp), where `lower` are the last eight digits or
// all.
inline __m256i shortest(__m256i lower, __m256i whole, __m256i rest, __m256i five, __m256i shift) {
  const __m256i tenth = _mm256_srli_epi64(_mm256_mul_epu32(lower, all(0xCCCC'CCCD)), 35);
  const __m256i tens = _mm256_mul_epu32(tenth, all(10));
  const __m256i below = _mm256_add_epi64(rest, _mm256_sllv_epi64(_mm256_sub_epi64(lower, tens), shift));
  const __m256i down = _mm256_cmpgt_epi64(five, below);
  const __m256i up = _mm256_cmpgt_epi64(below, _mm256_sub_epi64(_mm256_sllv_epi64(all(10), shift), five));
  const __m256i half = _mm256_srli_epi64(_mm256_sllv_epi64(all(1), shift), 1);
  const __m256i odd = _mm256_and_si256(whole, all(1));
  const __m256i nearest = _mm256_sub_epi64(lower, _mm256_cmpgt_epi64(_mm256_add_epi64(rest, odd), half));
  const __m256i nearer_ten = _mm256_add_epi64(tens, _mm256_and_si256(up, all(10)));
  return _mm256_blendv_epi8(nearest, nearer_ten, _mm256_or_si256(down, up));
}

// Nine digits, and eight more.
struct Digits {
  __m256i nine, eight;
};

template <class Number>
Digits shortest_digits(const Work& work, std::size_t at) {
  const __m256i word = load(&work.word[at]), five = five_of(word), shift = shift_of(word);
  const __m256i whole = load(&work.whole[at]), rest = load(&work.rest[at]);
  if constexpr (!is_double<Number>) return {shortest(whole, whole, rest, five, shift), all(0)};
  const __m256i upper = by_ten_to_8(whole);
  const __m256i lower = _mm256_sub_epi64(whole, _mm256_mul_epu32(upper, all(ten_to_8)));
  const __m256i last = shortest(lower, whole, rest, five, shift);
  const __m256i carry = _mm256_cmpgt_epi64(last, all(ten_to_8 - 1));
  return {_mm256_sub_epi64(upper, carry), _mm256_andnot_si256(carry, last)};
}

// The number of zeros before the first digit, as a negative number: at most one of a double, and two of a float.
template <class Number>
__m256i zeros_of(__m256i nine) {
  const __m256i one = _mm256_cmpgt_epi64(all(ten_to_8), nine);
  if constexpr (is_double<Number>) return one;
  return _mm256_add_epi64(one, _mm256_cmpgt_epi64(all(ten_to_8 / 10), nine));
}

// Second part: the shortest decimals of four numbers, with their scales and first digits written.
template <class Number>
void decide(Work& work, DecimalBatch<Number>& batch, std::size_t at) {
  const Digits digits = shortest_digits<Number>(work, at);
  const __m256i first = _mm256_srli_epi64(_mm256_mul_epu32(digits.nine, all(1'441'151'881)), 57);  // / 10^8
  store(&work.eight[at], _mm256_sub_epi64(digits.nine, _mm256_mul_epu32(first, all(ten_to_8))));
  store(&work.others[at], digits.eight);

  const __m256i text = _mm256_slli_epi64(_mm256_or_si256(first, all('0')), 56);
  const __m128d even = _mm_castsi128_pd(_mm256_castsi256_si128(text));
  const __m128d odd = _mm_castsi128_pd(_mm256_extracti128_si256(text, 1));
  _mm_storel_pd(reinterpret_cast<double*>(batch.texts[at].data()), even);
  _mm_storel_pd(reinterpret_cast<double*>(batch.texts[at + 1].data()), odd);
  _mm_storeh_pd(reinterpret_cast<double*>(batch.texts[at + 2].data()), even);
  _mm_storeh_pd(reinterpret_cast<double*>(batch.texts[at + 3].data()), odd);

  const __m256i zeros = zeros_of<Number>(digits.nine);
  const __m256i exponent =
      _mm256_and_si256(_mm256_srli_epi64(load(&work.word[at]), exponent_at), all(first_bits(shift_at - exponent_at)));
  const __m256i scales =
      _mm256_blend_epi32(_mm256_add_epi32(exponent, zeros), _mm256_slli_epi64(zeros, 32), 0b10101010);
  _mm256_store_si256(reinterpret_cast<__m256i*>(&batch.scales[at]), _mm256_permute4x64_epi64(scales, 0b11011000));
}

// The digits of four numbers below 10^8, a byte each, the first digit first (shortest_decimal.cpp).
inline __m256i digits_of(__m256i eights) {
  __m256i part = _mm256_srli_epi64(_mm256_mul_epu32(eights, all(3'518'437'209)), 45);  // / 10^4
  const __m256i fours =
      _mm256_or_si256(part, _mm256_slli_epi64(_mm256_sub_epi64(eights, _mm256_mul_epu32(part, all(10'000))), 32));
  part = _mm256_srli_epi16(_mm256_mulhi_epu16(fours, _mm256_set1_epi16(5243)), 3);  // / 100
  const __m256i twos = _mm256_or_si256(
      part, _mm256_slli_epi32(_mm256_sub_epi16(fours, _mm256_madd_epi16(part, _mm256_set1_epi16(100))), 16));
  part = _mm256_mulhi_epu16(twos, _mm256_set1_epi16(6554));  // / 10
  return _mm256_or_si256(
      part, _mm256_slli_epi16(_mm256_sub_epi16(twos, _mm256_maddubs_epi16(part, _mm256_set1_epi8(10))), 8));
}

// The sixteen digits of each of two numbers behind the first.
template <class Number>
void write_two(__m256i digits, DecimalBatch<Number>& batch, std::size_t at) {
  constexpr std::size_t behind = DecimalBatch<Number>::digits_at + 1;
  const __m256i is_zero = _mm256_cmpeq_epi8(digits, _mm256_setzero_si256());
  const unsigned nonzero = ~static_cast<unsigned>(_mm256_movemask_epi8(is_zero));
  __builtin_memcpy(&batch.nonzero[at], &nonzero, sizeof nonzero);
  const __m256i text = _mm256_or_si256(digits, _mm256_set1_epi8('0'));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(batch.texts[at].data() + behind), _mm256_castsi256_si128(text));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(batch.texts[at + 1].data() + behind), _mm256_extracti128_si256(text, 1));
}

template <class Number>
void convert(DecimalBatch<Number>& batch) {
  Work work;
  for (std::size_t at = 0; at < size; at += lanes) scale(&batch.numbers[at], work, at);
  for (std::size_t at = 0; at < size; at += lanes) decide(work, batch, at);
  for (std::size_t at = 0; at < size; at += lanes) {
    const __m256i eight = load(&work.eight[at]), others = load(&work.others[at]);
    write_two(digits_of(_mm256_unpacklo_epi64(eight, others)), batch, at);
    write_two(digits_of(_mm256_unpackhi_epi64(eight, others)), batch, at + 2);
  }
}

}  // namespace

void convert_avx2(DecimalBatch<double>& batch) {
  convert(batch);
}

void convert_avx2(DecimalBatch<float>& batch) {
  convert(batch);
}

}  // namespace carom

#else

namespace carom {

void convert_avx2(DecimalBatch<double>&) {}
void convert_avx2(DecimalBatch<float>&) {}

}  // namespace carom

#endif
