// The clearance of a place is at most its distance from the nearest obstacle, and not much smaller.
#include "core/disks/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

constexpr std::size_t cells = 4000;
constexpr double cell = 0.5;  // 80 by 50 cells

Domain box_of(bool periodic) {
  return test::box_of(40.0, 25.0, periodic ? test::Periodic::both : test::Periodic::none);
}

// Disks, segments and thick segments, some of which reach beyond the sides.
std::vector<Clearance::Shape> random_shapes(test::Draws& draws, std::size_t n, const Domain& box) {
  std::vector<Clearance::Shape> all;
  for (std::size_t k = 0; k < n; ++k) {
    Clearance::Shape s;
    s.from = {draws.in(-1.0, box.width + 1.0), draws.in(-1.0, box.height + 1.0)};
    if (k % 3 != 0) s.along = {draws.in(-0.4, 0.4) * box.width, draws.in(-0.4, 0.4) * box.height};
    if (k % 3 != 1) s.radius = draws.decades(0.01, 2.0);
    all.push_back(s);
  }
  return all;
}

double distance(const Clearance::Shape& s, double x, double y) {
  const double px = x - s.from.x;
  const double py = y - s.from.y;
  const double length2 = s.along.x * s.along.x + s.along.y * s.along.y;
  const double share = length2 > 0.0 ? std::clamp((px * s.along.x + py * s.along.y) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(px - share * s.along.x, py - share * s.along.y) - s.radius;
}

// The distance from the nearest shape, including images within two periods.
double nearest(const std::vector<Clearance::Shape>& shapes, double x, double y, const Domain& box) {
  const int periods = box.periodic_x() ? 2 : 0;
  double least = HUGE_VAL;
  for (const Clearance::Shape& s : shapes) {
    for (int kx = -periods; kx <= periods; ++kx) {
      for (int ky = -periods; ky <= periods; ++ky) {
        least = std::min(least, distance(s, x - kx * box.width, y - ky * box.height));
      }
    }
  }
  return least;
}

class Clear : public testing::TestWithParam<bool> {};

TEST_P(Clear, NothingIsNearerThanItSays) {
  const Domain box = box_of(GetParam());
  for (const std::size_t n : {1U, 3U, 12U}) {
    test::Draws draws(n);
    const std::vector<Clearance::Shape> shapes = random_shapes(draws, n, box);
    const Clearance clearance(box, shapes, cells);
    std::size_t clear = 0;
    for (int k = 0; k < 3000; ++k) {
      const double x = draws.in(0.0, box.width);
      const double y = draws.in(0.0, box.height);
      const double known = clearance.at({x, y});
      const double is = nearest(shapes, x, y, box);
      ASSERT_LT(known, std::max(is, 0.0) + 1e-12) << x << ' ' << y;
      clear += known > cell ? 1 : 0;
      // Distances further off are counted in cells along one axis, which gives at least 1/sqrt(2) of them. Place and
      // shape may be anywhere in their cells; shapes are marked half a diagonal too far, and those that reach beyond a
      // wall with their whole rectangle.
      if (GetParam()) {
        ASSERT_GE(known, is / std::sqrt(2.0) - 3.5 * cell) << x << ' ' << y;
      }
    }
    EXPECT_GT(clear, 300U);
  }
}

// A clear rectangle may reach over periodic sides.
TEST_P(Clear, RectanglesAreEmpty) {
  const Domain box = box_of(GetParam());
  test::Draws draws(7);
  const std::vector<Clearance::Shape> shapes = random_shapes(draws, 5, box);
  const Clearance clearance(box, shapes, cells);
  std::size_t clear = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vec2 middle{draws.in(0.0, box.width), draws.in(0.0, box.height)};
    const Vec2 half{draws.decades(0.01, 8.0), draws.decades(0.01, 8.0)};
    if (!clearance.is_clear({middle.x - half.x, middle.y - half.y}, {middle.x + half.x, middle.y + half.y})) continue;
    ++clear;
    for (int m = 0; m < 20; ++m) {
      const double x = middle.x + draws.in(-1.0, 1.0) * half.x;
      const double y = middle.y + draws.in(-1.0, 1.0) * half.y;
      ASSERT_GT(nearest(shapes, x, y, box), 0.0) << x << ' ' << y;
    }
  }
  EXPECT_GT(clear, 500U);
}

INSTANTIATE_TEST_SUITE_P(Sides, Clear, testing::Bool());

TEST(Clearance, OfAnEmptyBoxIsWide) {
  const Clearance clearance(box_of(true), std::vector<Clearance::Shape>{}, cells);
  EXPECT_TRUE(clearance.is_clear({-5.0, -5.0}, {45.0, 30.0}));
  EXPECT_FALSE(clearance.is_clear({80.0, 10.0}, {81.0, 11.0})) << "the middle of this rectangle is out of the box";
}

// The area swept by a moving wall may be longer than several periods, and begin far from the box.
TEST(Clearance, OfWhatIsLongerThanAPeriod) {
  const std::vector<Clearance::Extent> swept{{{-400.0, 10.0}, {900.0, 11.0}}};
  const Clearance clearance(box_of(true), swept, cells);
  for (double x = 0.1; x < 40.0; x += 0.4) {
    EXPECT_LE(clearance.at({x, 12.0}), 1.0);
    EXPECT_GT(clearance.at({x, 16.0}), 4.0);
    EXPECT_GT(clearance.at({x, 2.0}), 6.9);
  }
}

}  // namespace
}  // namespace carom
