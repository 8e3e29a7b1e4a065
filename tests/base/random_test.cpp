// Random numbers: Philox compared with its published vectors, uniform deviates, the logarithm, normal deviates.
#include "core/base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/draws.hpp"

namespace carom {
namespace {

// A uniform as random.hpp defines it: the upper 52 of 64 bits, centred.
double uniform_of(std::uint32_t low, std::uint32_t high) {
  return (static_cast<double>(((std::uint64_t{high} << 32) | low) >> 12) + 0.5) * 0x1p-52;
}

// From Random123, tests/kat_vectors, the three lines of philox4x32 with 10 rounds: counter, key, output. The counter is
// (step, id, stream and attempt) and the key is the seed, so this fixes the whole layout.
TEST(Philox, KnownAnswers) {
  const TwoUniforms zeros = uniforms(0, Stream{0}, 0, 0, 0);
  EXPECT_EQ(zeros.a, uniform_of(0x6627e8d5U, 0xe169c58dU));
  EXPECT_EQ(zeros.b, uniform_of(0xbc57ac4cU, 0x9b00dbd8U));
  const TwoUniforms ones = uniforms(~0ULL, Stream{0xffffffU}, ~0U, ~0ULL, 0xffU);
  EXPECT_EQ(ones.a, uniform_of(0x408f276dU, 0x41c83b0eU));
  EXPECT_EQ(ones.b, uniform_of(0xa20bc7c6U, 0x6d5451fdU));
  const TwoUniforms pi = uniforms(0x299f31d0a4093822ULL, Stream{0x037073U}, 0x13198a2eU, 0x85a308d3243f6a88ULL, 0x44U);
  EXPECT_EQ(pi.a, uniform_of(0xd16cfe09U, 0x94fdccebU));
  EXPECT_EQ(pi.b, uniform_of(0x5001e420U, 0x24126ea1U));
}

TEST(Uniforms, AreAFunctionOfEveryArgument) {
  const TwoUniforms u = uniforms(7, Stream::position, 3, 11, 2);
  const auto differs = [&](const TwoUniforms& v) { return u.a != v.a && u.b != v.b; };
  EXPECT_FALSE(differs(uniforms(7, Stream::position, 3, 11, 2)));
  EXPECT_TRUE(differs(uniforms(8, Stream::position, 3, 11, 2)));
  EXPECT_TRUE(differs(uniforms(7 + (1ULL << 32), Stream::position, 3, 11, 2)));
  EXPECT_TRUE(differs(uniforms(7, Stream::velocity, 3, 11, 2)));
  EXPECT_TRUE(differs(uniforms(7, Stream::position, 4, 11, 2)));
  EXPECT_TRUE(differs(uniforms(7, Stream::position, 3, 12, 2)));
  EXPECT_TRUE(differs(uniforms(7, Stream::position, 3, 11 + (1ULL << 32), 2)));
  EXPECT_TRUE(differs(uniforms(7, Stream::position, 3, 11, 3)));
}

// n = 100000: the mean is 1/2, the variance 1/12, and the two numbers are uncorrelated; the tolerance is four standard
// errors.
TEST(Uniforms, LieInTheOpenUnitIntervalEvenly) {
  constexpr int n = 100000;
  double sum = 0.0;
  double squares = 0.0;
  double product = 0.0;
  double smallest = 1.0;
  double largest = 0.0;
  for (int k = 0; k < n; ++k) {
    const TwoUniforms u = uniforms(1, Stream::mass, 5, static_cast<std::uint64_t>(k));
    sum += u.a - 0.5;
    squares += (u.a - 0.5) * (u.a - 0.5);
    product += (u.a - 0.5) * (u.b - 0.5);
    smallest = std::min({smallest, u.a, u.b});
    largest = std::max({largest, u.a, u.b});
  }
  EXPECT_GT(smallest, 0.0);
  EXPECT_LT(largest, 1.0);
  EXPECT_LT(smallest, 1e-4);
  EXPECT_GT(largest, 1.0 - 1e-4);
  EXPECT_NEAR(sum / n, 0.0, 4.0 * std::sqrt(1.0 / 12.0 / n));
  EXPECT_NEAR(squares / n, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 180.0 / n));
  EXPECT_NEAR(product / n, 0.0, 4.0 * (1.0 / 12.0) / std::sqrt(1.0 * n));
}

double log_error(double x) {
  const long double exact = std::log(static_cast<long double>(x));
  return static_cast<double>(std::abs((static_cast<long double>(deterministic_log(x)) - exact) / exact));
}

TEST(DeterministicLog, AgreesWithTheLibraryOverAllMagnitudes) {
  double worst = 0.0;
  test::Draws draws(1);
  for (int exponent = -1022; exponent <= 1023; ++exponent) {
    for (int k = 0; k < 8; ++k) {
      const double x = std::ldexp(draws.in(1.0, 2.0), exponent);
      worst = std::max(worst, log_error(x));
    }
  }
  for (int k = 0; k < 20000; ++k) worst = std::max(worst, log_error(draws.in(0.0, 1.0)));
  EXPECT_LT(worst, 4e-16);
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

// Near x = 1, where log x tends to 0, the relative error counts; and at the ends of the reduction, sqrt(1/2) and
// sqrt(2).
TEST(DeterministicLog, AgreesNearOneAndAtTheSeams) {
  double worst = 0.0;
  for (int k = 1; k <= 52; ++k) {
    worst = std::max({worst, log_error(1.0 + std::ldexp(1.0, -k)), log_error(1.0 - std::ldexp(1.0, -k - 1))});
  }
  test::Draws draws(2);
  for (int k = 0; k < 20000; ++k) {
    worst = std::max(worst, log_error(1.0 + draws.in(-1.0, 1.0) * draws.decades(1e-15, 0.4)));
    worst = std::max(worst, log_error(std::sqrt(0.5) * (1.0 + draws.in(-1e-10, 1e-10))));
    worst = std::max(worst, log_error(std::sqrt(2.0) * (1.0 + draws.in(-1e-10, 1e-10))));
  }
  EXPECT_LT(worst, 4e-16);
  EXPECT_EQ(deterministic_log(1.0), 0.0);
}

TEST(DeterministicExp, AgreesWithTheLibraryAndKeepsItsBits) {
  test::Draws draws(3);
  double worst = 0.0;
  for (int k = 0; k < 40000; ++k) {
    const double x = k % 2 == 0 ? draws.in(-700.0, 700.0) : draws.in(-2.0, 2.0);
    const long double exact = std::exp(static_cast<long double>(x));
    worst = std::max(worst,
                     static_cast<double>(std::abs((static_cast<long double>(deterministic_exp(x)) - exact) / exact)));
  }
  EXPECT_LT(worst, 4e-16);
  EXPECT_EQ(deterministic_exp(0.0), 1.0);
  EXPECT_EQ(deterministic_exp(1.0), 0x1.5bf0a8b14576ap+1);
  EXPECT_EQ(deterministic_exp(-3.7), 0x1.9511fc6871044p-6);
}

// P(normal < x)
double normal_below(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

std::vector<double> normal_sample(int pairs) {
  std::vector<double> sample;
  for (int k = 0; k < pairs; ++k) {
    const Vec2 v = normals(2024, Stream::brownian, static_cast<DiskId>(k % 1000), static_cast<std::uint64_t>(k / 1000));
    sample.push_back(v.x);
    sample.push_back(v.y);
  }
  return sample;
}

// Moments of a standard normal deviate: 0, 1, 0, 3; the variances of their estimates are 1/n, 2/n, 15/n, 96/n. The
// tolerance is four standard errors.
TEST(Normals, Moments) {
  const std::vector<double> sample = normal_sample(100000);
  const auto n = static_cast<double>(sample.size());
  double moment[5] = {};
  double product = 0.0;
  for (std::size_t i = 0; i < sample.size(); i += 2) product += sample[i] * sample[i + 1];
  for (const double x : sample) {
    for (int k = 1; k <= 4; ++k) moment[k] += std::pow(x, k) / n;
  }
  EXPECT_NEAR(moment[1], 0.0, 4.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(moment[2], 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(moment[3], 0.0, 4.0 * std::sqrt(15.0 / n));
  EXPECT_NEAR(moment[4], 3.0, 4.0 * std::sqrt(96.0 / n));
  EXPECT_NEAR(product / (0.5 * n), 0.0, 4.0 * std::sqrt(2.0 / n));
}

// The test of Kolmogorov and Smirnov: sqrt(n) D exceeds 1.95 with probability 0.001. Chi-square of 100 equally likely
// bins: mean 99, standard deviation sqrt(198); the tolerance is four times that.
TEST(Normals, Distribution) {
  std::vector<double> sample = normal_sample(100000);
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double distance = 0.0;
  std::vector<double> bins(100, 0.0);
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double p = normal_below(sample[i]);
    const auto below = static_cast<double>(i);
    distance = std::max({distance, std::abs(p - below / n), std::abs(p - (below + 1.0) / n)});
    bins[std::min<std::size_t>(99, static_cast<std::size_t>(p * 100.0))] += 1.0;
  }
  EXPECT_LT(distance * std::sqrt(n), 1.95);
  double chi2 = 0.0;
  for (const double count : bins) chi2 += (count - n / 100.0) * (count - n / 100.0) / (n / 100.0);
  EXPECT_NEAR(chi2, 99.0, 4.0 * std::sqrt(198.0));
}

// The bits of the first deviates, which every IEEE machine must give; a change here changes every Brownian run.
TEST(Normals, PinnedBits) {
  const Vec2 first = normals(1, Stream::brownian, 0, 0);
  const Vec2 other = normals(123456789, Stream::velocity, 42, 1000000);
  EXPECT_EQ(first.x, 0x1.b452f5d5fc288p-2);
  EXPECT_EQ(first.y, 0x1.97742cd995814p-1);
  EXPECT_EQ(other.x, 0x1.0bb255cef4d33p+0);
  EXPECT_EQ(other.y, -0x1.7db32d8ff23d2p-1);
}

}  // namespace
}  // namespace carom
