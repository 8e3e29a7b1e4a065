// The shortest decimals of many numbers at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carom {

// Numbers, and the digits of those that a kernel has converted.
template <class Number>
struct DecimalBatch {
  static constexpr std::size_t size = 64;

  // A number is d.dddd * 10^exponent, where its first digit is the one behind the zeros.
  struct Scale {
    std::uint32_t exponent;  // minus first_exponent (decimal_scale.hpp); near unconverted: there are no digits
    std::int32_t zeros;      // at the beginning, minus their number
  };
  static constexpr std::uint32_t unconverted = 64;
  static constexpr std::size_t digits_at = 7;  // in a text

  alignas(64) std::array<Number, size> numbers{};
  alignas(64) std::array<std::array<char, 32>, size> texts{};  // seventeen digits each, from byte digits_at on
  alignas(32) std::array<Scale, size> scales{};
  alignas(32) std::array<std::uint16_t, size> nonzero{};  // bit k: digit k + 1 is not 0, where the first is digit 0
};

// Finds the digits of the numbers of a batch. The baseline converts none.
template <class Number>
using DecimalKernel = void (*)(DecimalBatch<Number>& batch);
template <class Number>
DecimalKernel<Number> choose_decimal_kernel();

void convert_avx2(DecimalBatch<double>& batch);
void convert_avx2(DecimalBatch<float>& batch);

// Writes the number of this index, with the same characters as write_shortest and in the same room, in two fifths of
// its time if the number is converted. Returns the end of the text. Precondition: a kernel has been called for the
// batch.
char* write_decimal(char* out, const DecimalBatch<double>& batch, std::size_t k);
char* write_decimal(char* out, const DecimalBatch<float>& batch, std::size_t k);

}  // namespace carom
