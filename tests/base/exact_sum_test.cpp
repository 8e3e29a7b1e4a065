// A sum of doubles without rounding, Kulisch's accumulator, compared with integers that represent the same sums.
#include "core/base/exact_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace carom {
namespace {

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double x : terms) sum.add(x);
  return sum.value();
}

TEST(ExactSum, KeepsWhatCancellationLeaves) {
  EXPECT_EQ(sum_of({}), 0.0);
  EXPECT_EQ(sum_of({1e300, 1.0, -1e300}), 1.0);
  EXPECT_EQ(sum_of({1e300, -1.0, -1e300}), -1.0);
  EXPECT_EQ(sum_of({0.1, 0.2, -0.1, -0.2}), 0.0);
  const double tiniest = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(sum_of({1.0, tiniest, -1.0, tiniest}), 2.0 * tiniest);
  EXPECT_EQ(sum_of({-0x1p-1022, tiniest}), -0x1p-1022 + tiniest);
  EXPECT_EQ(sum_of({0x1p1023, -0x1p1022}), 0x1p1022);
}

// Rounding is to nearest, with ties to even; a single bit far below a tie decides it.
TEST(ExactSum, RoundsCorrectly) {
  EXPECT_EQ(sum_of({1.0, 0x1p-53}), 1.0);
  EXPECT_EQ(sum_of({1.0 + 0x1p-52, 0x1p-53}), 1.0 + 0x1p-51);
  EXPECT_EQ(sum_of({1.0, 0x1p-53, 0x1p-1000}), 1.0 + 0x1p-52);
  EXPECT_EQ(sum_of({1.0, 0x1p-53, -0x1p-1000}), 1.0);
  EXPECT_EQ(sum_of({-1.0, -0x1p-53, -0x1p-1000}), -1.0 - 0x1p-52);
}

// Terms are k 2^p with |k| < 2^53 and p in [-40, 0]: the sum of 2000 of them fits into 128 bits, whose conversion
// rounds correctly.
TEST(ExactSum, IsTheSumInAnyOrderAndScale) {
  __extension__ using Integer = __int128;
  std::mt19937_64 random(20240501);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> terms;
    Integer exact = 0;
    for (int k = 0; k < 2000; ++k) {
      const auto mantissa = static_cast<std::int64_t>(random() >> 11) - (std::int64_t{1} << 52);
      const int power = static_cast<int>(random() % 41);
      terms.push_back(std::ldexp(static_cast<double>(mantissa), power - 40));
      exact += static_cast<Integer>(mantissa) << power;
    }
    const double expected = std::ldexp(static_cast<double>(exact), -40);
    EXPECT_EQ(sum_of(terms), expected);
    std::shuffle(terms.begin(), terms.end(), random);
    EXPECT_EQ(sum_of(terms), expected);
    ExactSum halves[2];
    for (std::size_t k = 0; k < terms.size(); ++k) halves[k % 2].add(terms[k]);
    halves[0].add(halves[1]);
    EXPECT_EQ(halves[0].value(), expected);
    for (const int shift : {-940, -20, -7, 13, 20, 900}) {
      std::vector<double> scaled = terms;
      for (double& x : scaled) x = std::ldexp(x, shift);
      EXPECT_EQ(sum_of(scaled), std::ldexp(expected, shift)) << shift;
    }
  }
}

// Terms added as an array give the same sum as terms added one by one: for lengths around that of blocks; for ranges of
// exponents within, beyond and far beyond that of the fast method; with zeros; and with terms that cancel except for
// the last bit.
TEST(ExactSum, OfManyIsThatOfEach) {
  std::mt19937_64 random(20261125);
  const auto mantissa = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53) + 0.5; };
  for (const int range : {1, 30, 60, 200, 2000}) {
    for (const std::size_t count : {0U, 1U, 63U, 64U, 255U, 256U, 257U, 1000U, 5000U}) {
      std::vector<double> terms(count);
      for (double& x : terms) {
        const int power = static_cast<int>(random() % static_cast<std::uint64_t>(range)) - range / 2;
        x = random() % 9 == 0 ? 0.0 : std::ldexp(random() % 2 == 0 ? mantissa() : -mantissa(), power);
      }
      for (std::size_t k = 0; k + 2 < count; k += 3) terms[k + 1] = std::nextafter(-terms[k], 1.0);
      ExactSum whole;
      whole.add(1.0);
      whole.add(std::span<const double>(terms));
      whole.add(-1.0);
      EXPECT_EQ(whole.value(), sum_of(terms)) << range << ' ' << count;
    }
  }
}

// The common scale of the terms may be near either end of the range of doubles.
TEST(ExactSum, OfManyAtTheEndsOfAllDoubles) {
  for (const double unit : {0x1p-1074, 0x1p-1022, 0x1p-901, 0x1p-900, 0x1p899, 0x1p900, 0x1p1010}) {
    std::vector<double> terms;
    for (int k = 0; k < 600; ++k) terms.push_back((k % 2 == 0 ? 1.0 : -1.5) * unit * k);
    ExactSum whole;
    whole.add(std::span<const double>(terms));
    EXPECT_EQ(whole.value(), sum_of(terms)) << unit;
  }
}

}  // namespace
}  // namespace carom
