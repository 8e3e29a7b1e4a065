// Errors by blocking, and the diffusion coefficient of a displacement with its error, compared with known results.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/blocking_error.hpp"
#include "core/base/random.hpp"
#include "core/measure/diffusion_fit.hpp"

namespace carom {
namespace {

constexpr std::size_t samples = 1 << 15;

// x_k+1 = a x_k + sqrt(1 - a^2) noise: variance 1 and correlation a^k, so the mean of n has the error sqrt((1 + a) / (1
// - a) / n).
std::vector<double> correlated(double a, std::uint64_t seed, std::size_t count = samples) {
  std::vector<double> series(count);
  double x = normals(seed, Stream::velocity, 0, 0).x;
  for (std::size_t k = 0; k < count; ++k) {
    series[k] = 3.0 + x;
    x = a * x + std::sqrt(1.0 - a * a) * normals(seed, Stream::velocity, 1, k).x;
  }
  return series;
}

TEST(BlockingError, KnowsCorrelations) {
  for (const double a : {0.0, 0.5, 0.9, 0.97}) {
    double mean = 0.0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) mean += blocking_error(correlated(a, seed)) / 8.0;
    const double known = std::sqrt((1.0 + a) / (1.0 - a) / samples);
    // The largest of several estimates is a little too large, by about one of their own errors.
    EXPECT_GT(mean, 0.95 * known) << a;
    EXPECT_LT(mean, 1.25 * known) << a;
  }
}

TEST(BlockingError, OfFewSamplesIsThatOfIndependentOnes) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(blocking_error({missing, 1.0, 2.0, missing, 3.0, 4.0}), std::sqrt(1.25 / 3.0));
  EXPECT_TRUE(std::isnan(blocking_error({missing, 1.0})));
  EXPECT_TRUE(std::isnan(blocking_error({})));
}

// Samples of 1 and -1 in turn, `length` of each.
std::vector<double> square_wave(std::size_t count, std::size_t length) {
  std::vector<double> series(count);
  for (std::size_t k = 0; k < count; ++k) series[k] = k / length % 2 == 0 ? 1.0 : -1.0;
  return series;
}

// Blocks of two average out such samples, so the largest estimate is the first one.
TEST(BlockingError, IsTheLargestOfTheEstimates) {
  EXPECT_DOUBLE_EQ(blocking_error(square_wave(128, 1)), std::sqrt(1.0 / 127.0));
}

// For these samples estimates grow with the length of blocks up to four. With 64 samples there are too few such blocks,
// so the estimate is that of blocks of two.
TEST(BlockingError, TakesNoFewerThan32Blocks) {
  EXPECT_DOUBLE_EQ(blocking_error(square_wave(64, 4)), std::sqrt(1.0 / 31.0));
  EXPECT_DOUBLE_EQ(blocking_error(square_wave(128, 4)), std::sqrt(1.0 / 31.0));
}

// With few samples blocks, of which there must be 32, are shorter than the correlations: the error must still be the
// scatter of the mean, if there are at least eight correlation times.
TEST(BlockingError, KnowsCorrelationsThatAreLongerThanItsBlocks) {
  struct Case {
    std::size_t count;
    double time;  // decay time of correlations, in samples
  };
  for (const auto& [count, time] : {Case{40, 3.0}, Case{100, 0.0}, Case{100, 3.0}, Case{100, 11.0}, Case{250, 11.0},
                                    Case{500, 33.0}, Case{1000, 100.0}}) {
    double off2 = 0.0, error2 = 0.0;
    const double a = time > 0.0 ? std::exp(-1.0 / time) : 0.0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      const std::vector<double> series = correlated(a, seed, count);
      const double mean = std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(count);
      const double error = blocking_error(series);
      off2 += (mean - 3.0) * (mean - 3.0);
      error2 += error * error;
    }
    EXPECT_GT(error2, 0.7 * off2) << count << " samples, correlated over " << time;
    EXPECT_LT(error2, 1.6 * off2) << count << " samples, correlated over " << time;
  }
}

// Of ten blocks 1, 1, 1, 1, 1, -1, ..., -1 all neighbours except one pair are equal.
TEST(BlockingError, OfCorrelatedBlocksByHand) {
  EXPECT_DOUBLE_EQ(blocking_error(square_wave(10, 5)), std::sqrt(1.0 / 9.0 * (1.0 + 0.7) / (1.0 - 0.7)));
  EXPECT_DOUBLE_EQ(blocking_error({2.0, 2.0, 2.0}), 0.0);
}

// Means over intervals of many lengths, whose errors go as 1 / sqrt(interval): short intervals scatter most and weigh
// least.
TEST(BlockingError, OfAWeightedMeanIsWhatThatScattersBy) {
  double off2 = 0.0, error2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    std::vector<double> rates, lengths;
    double sum = 0.0, weight = 0.0;
    for (std::uint64_t k = 0; k < 100; ++k) {
      const double length = k % 10 == 0 ? 1e-3 : 1.0;
      rates.push_back(3.0 + normals(seed, Stream::velocity, 0, k).x / std::sqrt(length));
      lengths.push_back(length);
      sum += length * rates.back();
      weight += length;
    }
    off2 += (sum / weight - 3.0) * (sum / weight - 3.0);
    const double error = blocking_error(rates, lengths);
    error2 += error * error;
  }
  EXPECT_GT(error2, 0.8 * off2);
  EXPECT_LT(error2, 1.8 * off2);
  EXPECT_TRUE(std::isnan(blocking_error({1.0, 2.0, 3.0}, {1.0, 0.0, 0.0}))) << "only one sample has a weight";
}

// Random walks of 400 disks with D = 0.5.
TEST(DiffusionFit, FindsThatOfARandomWalkWithinItsError) {
  constexpr double d = 0.5, dt = 0.1;
  double off2 = 0.0, error2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Vec2> place(400);
    std::vector<double> time, square;
    for (std::uint64_t step = 0; step <= 200; ++step) {
      double sum = 0.0;
      for (const Vec2& p : place) sum += p.x * p.x + p.y * p.y;
      time.push_back(static_cast<double>(step) * dt);
      square.push_back(sum / 400.0);
      for (DiskId id = 0; id < 400; ++id) {
        const Vec2 u = normals(seed, Stream::brownian, id, step);
        place[id].x += std::sqrt(2.0 * d * dt) * u.x;
        place[id].y += std::sqrt(2.0 * d * dt) * u.y;
      }
    }
    const DiffusionFit fit = fit_diffusion(time, square);
    EXPECT_DOUBLE_EQ(fit.from, 10.0);
    EXPECT_NEAR(fit.value, d, 5.0 * fit.error) << seed;
    off2 += (fit.value - d) * (fit.value - d);
    error2 += fit.error * fit.error;
  }
  EXPECT_GT(error2, 0.4 * off2) << "the errors must be roughly the true ones";
  EXPECT_LT(error2, 2.5 * off2);
}

// Starting at 100 the first half does not count. The second half is divided into eight parts, which have D = 1 and 3 in
// turn.
TEST(DiffusionFit, ErrorIsThatOfTheMeanOfEightParts) {
  std::vector<double> time, square;
  for (int k = 0; k <= 32; ++k) {
    time.push_back(100.0 + k);
    const double before = k > 0 ? square.back() : 0.0;
    square.push_back(k <= 16 ? 0.0 : before + 4.0 * ((k - 17) / 2 % 2 == 0 ? 1.0 : 3.0));
  }
  const DiffusionFit fit = fit_diffusion(time, square);
  EXPECT_EQ(fit.from, 116.0);
  EXPECT_EQ(fit.value, 2.0);
  EXPECT_DOUBLE_EQ(fit.error, std::sqrt(8.0 / 7.0 / 8.0));
}

// Parts that are equal in pairs: the error is as if there were four parts.
TEST(DiffusionFit, ErrorKnowsOfPartsThatAreCorrelated) {
  std::vector<double> time, square;
  for (int k = 0; k <= 32; ++k) {
    time.push_back(k);
    const double before = k > 0 ? square.back() : 0.0;
    square.push_back(k <= 16 ? 0.0 : before + 4.0 * ((k - 17) / 4 % 2 == 0 ? 1.0 : 3.0));
  }
  const DiffusionFit fit = fit_diffusion(time, square);
  EXPECT_EQ(fit.value, 2.0);
  EXPECT_DOUBLE_EQ(fit.error, std::sqrt(4.0 / 3.0 / 4.0));
}

// Eight steps in the second half are enough, one for each part; seven are not.
TEST(DiffusionFit, NeedsEightStepsInTheSecondHalf) {
  std::vector<double> time, square;
  for (int k = 0; k <= 15; ++k) {
    time.push_back(k);
    square.push_back(12.0 * k);
  }
  EXPECT_TRUE(std::isnan(fit_diffusion(time, square).value)) << "seven steps, from 8 to 15";
  time.push_back(16.0);
  square.push_back(12.0 * 16.0);
  const DiffusionFit fit = fit_diffusion(time, square);
  EXPECT_EQ(fit.from, 8.0);
  EXPECT_DOUBLE_EQ(fit.value, 3.0);
  EXPECT_DOUBLE_EQ(fit_diffusion(time, square, 1.0).value, 6.0) << "along one axis";
}

TEST(DiffusionFit, SaysNothingOfFewSamples) {
  EXPECT_TRUE(std::isnan(fit_diffusion({0, 1, 2, 3}, {0, 1, 2, 3}).value));
  EXPECT_TRUE(std::isnan(fit_diffusion({}, {}).value));
}

}  // namespace
}  // namespace carom
