// Mean, scatter and standard error of samples, some of which may be missing.
#include "core/base/sample_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

TEST(SampleMean, OfAFewNumbers) {
  const SampleMean m = sample_mean({1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(m.samples, 4U);
  EXPECT_EQ(m.mean, 2.5);
  EXPECT_DOUBLE_EQ(m.deviation, std::sqrt(5.0 / 3.0));
  EXPECT_DOUBLE_EQ(m.standard_error(), 0.5 * std::sqrt(5.0 / 3.0));
}

TEST(SampleMean, WhatIsMissingDoesNotCountNorItsWeight) {
  const SampleMean plain = sample_mean({missing, 5.0, missing, 7.0});
  EXPECT_EQ(plain.samples, 2U);
  EXPECT_EQ(plain.mean, 6.0);
  EXPECT_DOUBLE_EQ(plain.deviation, std::sqrt(2.0));
  const SampleMean weighted = sample_mean({missing, 5.0, 7.0}, {100.0, 3.0, 1.0});
  EXPECT_EQ(weighted.samples, 2U);
  EXPECT_EQ(weighted.mean, 5.5);
}

TEST(SampleMean, OfOneOrNone) {
  const SampleMean one = sample_mean({3.0});
  EXPECT_EQ(one.mean, 3.0);
  EXPECT_EQ(one.deviation, 0.0);
  for (const SampleMean& none : {sample_mean({}), sample_mean({missing, missing})}) {
    EXPECT_EQ(none.samples, 0U);
    EXPECT_TRUE(std::isnan(none.mean));
    EXPECT_EQ(none.deviation, 0.0);
  }
}

}  // namespace
}  // namespace carom
