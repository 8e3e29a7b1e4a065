// Radii and masses drawn from distributions: moments, limits, the same bits everywhere, and bad distributions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/scene/size_law.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::size_t draws = 40'000;

SizeLaw law_of(SizeLaw::Kind kind, double value, double deviation) {
  SizeLaw law;
  law.kind = kind;
  law.value = value;
  law.deviation = deviation;
  return law;
}

// Mean and standard deviation of f over this number of radii.
struct Moments {
  double mean = 0.0, deviation = 0.0;
};
Moments moments(const SizeLaw& law, const std::function<double(double)>& f) {
  const SizeLaw mass = law_of(SizeLaw::Kind::constant, 1.0, 0.0);
  const SizeRange range = size_range(law);
  double sum = 0.0, squares = 0.0;
  for (DiskId id = 0; id < draws; ++id) {
    const double r = draw_size(law, mass, 9, Stream::radius, Stream::mass, id, id).radius;
    EXPECT_TRUE(r >= range.low && r <= range.high) << r;
    sum += f(r);
    squares += f(r) * f(r);
  }
  const double mean = sum / draws;
  return {mean, std::sqrt(squares / draws - mean * mean)};
}

// Four standard errors: s / sqrt(n) for the mean, s / sqrt(2 n) for the standard deviation.
const double of_mean = 4.0 / std::sqrt(static_cast<double>(draws));
const double of_deviation = of_mean / std::sqrt(2.0);

TEST(SizeDistributions, NormalHasItsMeanAndDeviation) {
  const Moments m = moments(law_of(SizeLaw::Kind::normal, 5.0, 0.5), [](double r) { return r; });
  EXPECT_NEAR(m.mean, 5.0, 0.5 * of_mean);
  EXPECT_NEAR(m.deviation, 0.5, 0.5 * of_deviation);
}

TEST(SizeDistributions, LognormalHasThemInItsLogarithm) {
  const Moments m = moments(law_of(SizeLaw::Kind::lognormal, 3.0, 0.4), [](double r) { return std::log(r); });
  EXPECT_NEAR(m.mean, std::log(3.0), 0.4 * of_mean);
  EXPECT_NEAR(m.deviation, 0.4, 0.4 * of_deviation);
}

TEST(SizeDistributions, ChoiceGoesByItsWeights) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::choice;
  law.values = {1.0, 7.0, 2.0, 4.0};
  law.weights = {1.0, 0.0, 2.0, 5.0};
  const double shares[] = {0.125, 0.0, 0.25, 0.625};
  for (std::size_t k = 0; k < 4; ++k) {
    const Moments m = moments(law, [&](double r) { return r == law.values[k] ? 1.0 : 0.0; });
    EXPECT_NEAR(m.mean, shares[k], std::sqrt(shares[k] * (1.0 - shares[k])) * of_mean) << k;
  }
}

TEST(SizeDistributions, RadiusAndMassOfADiskDoNotGoTogether) {
  const SizeLaw law = law_of(SizeLaw::Kind::normal, 1.0, 0.1);
  double product = 0.0;
  for (DiskId id = 0; id < draws; ++id) {
    const DiskSize size = draw_size(law, law, 9, Stream::radius, Stream::mass, id, id);
    product += (size.radius - 1.0) * (size.mass - 1.0) / 0.01;
  }
  EXPECT_NEAR(product / draws, 0.0, of_mean);
}

// The numbers were computed once; any other compiler or machine gives the same bits.
TEST(SizeDistributions, BitsAreTheSameEverywhere) {
  const SizeLaw mass = law_of(SizeLaw::Kind::lognormal, 2.0, 0.7);
  const SizeLaw radius = law_of(SizeLaw::Kind::normal, 1.0, 0.2);
  const DiskSize size = draw_size(radius, mass, 12345, Stream::radius, Stream::mass, 678, 0);
  EXPECT_EQ(size.radius, 0x1.6c584eacb879p-1);
  EXPECT_EQ(size.mass, 0x1.76e9f216227acp+0);
}

std::string with_radius(const std::string& law) {
  return complaint(replaced(test::sound_scene, "radius = 1.0", "radius = " + law));
}

TEST(SizeDistributions, BadOnesAreNamedByLineAndKey) {
  EXPECT_EQ(with_radius("{ normal = [1, 0.1] }"), "");
  EXPECT_EQ(with_radius("{ choice = [1, 0.5] }"), "");
  EXPECT_THAT(with_radius("{ normal = [1, 0.3] }"),
              StartsWith("gas.toml:17: disks.0.radius.normal: is [1, 0.3]; expected [mean, deviation] with"));
  EXPECT_THAT(with_radius("{ normal = [1] }"), HasSubstr("radius.normal: has 1 number; expected"));
  EXPECT_THAT(with_radius("{ normal = [1, -0.1] }"), HasSubstr("radius.normal: is [1, -0.1]; expected"));
  EXPECT_THAT(with_radius("{ lognormal = [0, 1] }"),
              HasSubstr("radius.lognormal: is [0, 1]; expected [median, sigma]"));
  EXPECT_THAT(with_radius("{ lognormal = [1, 3] }"),
              HasSubstr("radius.lognormal: is [1, 3]; expected [median, sigma]"));
  EXPECT_THAT(with_radius("{ choice = [] }"), HasSubstr("radius.choice: is empty; expected"));
  EXPECT_THAT(with_radius("{ choice = [1, 0] }"), HasSubstr("radius.choice.1: is 0; expected"));
  EXPECT_THAT(with_radius("{ choice = [1, 2], weights = [1] }"),
              HasSubstr("radius.weights: has 1 number for 2 values of choice; expected one for each"));
  EXPECT_THAT(with_radius("{ choice = [1, 2], weights = [1, -1] }"), HasSubstr("radius.weights.1: is -1; expected"));
  EXPECT_THAT(with_radius("{ choice = [1, 2], weights = [1, 2e9] }"), HasSubstr("radius.weights.1: is 2000000000"));
  EXPECT_THAT(with_radius("{ choice = [1, 2], weights = [0, 0] }"), HasSubstr("radius.weights: are all 0; expected"));
  EXPECT_THAT(with_radius("{ weights = [1] }"), HasSubstr("radius.choice: missing; expected"));
  EXPECT_THAT(with_radius("{ normal = [1, 0.1], uniform = [1, 2] }"),
              HasSubstr("disks.0.radius: has 2 keys; expected"));
  EXPECT_THAT(with_radius("{ norml = [1, 0.1] }"), HasSubstr("(nearest: normal)"));
  EXPECT_THAT(with_radius("{ lognormal = [3, 0.1] }"), HasSubstr("disk 0 of radius 3.23"));
}

TEST(SizeDistributions, ASourceIsCheckedAgainstItsLargestDisk) {
  const std::string source = "[[sources]]\nside = \"top\"\nrate = 1.0\nmass = 1.0\nradius = ";
  EXPECT_THAT(complaint(std::string(test::sound_scene) + source + "{ lognormal = [1.0, 0.5] }\n"),
              HasSubstr("is too small for a disk of radius 7.389"));
  EXPECT_EQ(complaint(std::string(test::sound_scene) + source + "{ lognormal = [0.5, 0.5] }\n"), "");
}

}  // namespace
}  // namespace carom
