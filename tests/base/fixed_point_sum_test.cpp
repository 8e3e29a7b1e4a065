// FixedPointSum: close to the sum of its terms, and the same for any order and any division into parts.
#include "core/base/fixed_point_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/draws.hpp"

namespace carom {
namespace {

FixedPointSum sum_of(const std::vector<double>& terms, std::size_t begin, std::size_t end) {
  FixedPointSum sum;
  for (std::size_t k = begin; k < end; ++k) sum += fixed_point(terms[k]);
  return sum;
}

TEST(FixedPointSum, IsExactOfMultiplesOfItsUnit) {
  EXPECT_EQ(value_of(sum_of({1.5, -2.0, 0x1p-40, -0x1p-20}, 0, 4)), -0.5 + 0x1p-40 - 0x1p-20);
  EXPECT_EQ(value_of(FixedPointSum{}), 0.0);
  // Anything below the unit is cut off, towards zero.
  EXPECT_EQ(value_of(sum_of({0x1.8p-40, -0x1.8p-40, -0x1.8p-41}, 0, 3)), 0.0);
}

TEST(FixedPointSum, IsTheSameInAnyOrderAndAnyParts) {
  test::Draws draws(11);
  std::vector<double> terms(100000);
  long double expected = 0.0L;
  for (double& term : terms) {
    term = draws.in(-2.0, 2.0);
    expected += static_cast<long double>(term);
  }
  const FixedPointSum all = sum_of(terms, 0, terms.size());
  EXPECT_NEAR(value_of(all), static_cast<double>(expected), 0x1p-40 * 1e5);
  const FixedPointSum first = sum_of(terms, 0, 7777), rest = sum_of(terms, 7777, terms.size());
  EXPECT_EQ(first.high + rest.high, all.high);
  EXPECT_EQ(first.low + rest.low, all.low);
  std::reverse(terms.begin(), terms.end());
  const FixedPointSum turned = sum_of(terms, 0, terms.size());
  EXPECT_EQ(turned.high, all.high);
  EXPECT_EQ(turned.low, all.low);
}

// As many terms of one sign as a bin may have with 10^9 disks, by adding a sum to itself.
TEST(FixedPointSum, HasRoomForMany) {
  FixedPointSum sum;
  sum += fixed_point(2.0 - 0x1p-40);
  for (int k = 0; k < 41; ++k) {
    sum.high *= 2;
    sum.low *= 2;
  }
  EXPECT_EQ(value_of(sum), 0x1p41 * (2.0 - 0x1p-40));
}

}  // namespace
}  // namespace carom
