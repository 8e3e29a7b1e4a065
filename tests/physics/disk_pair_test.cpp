// Two disks: contact, the time of contact compared with a computation in more digits, and the collision rule (23) of
// docs/original.md.
#include "core/physics/disk_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/draws.hpp"
#include "tests/support/wide.hpp"

namespace carom {
namespace {

using test::Wide;
using test::wide;

// The smaller root of (12) with a mantissa of 64 bits; infinity if the paths miss.
Wide touching_time_with_more_digits(const Relative& r, double reach) {
  const Wide dx = wide(r.dx), dy = wide(r.dy), dvx = wide(r.dvx), dvy = wide(r.dvy), s = wide(reach);
  const Wide a = dvx * dvx + dvy * dvy;
  const Wide cross = dx * dvy - dy * dvx;
  const Wide discriminant = a * s * s - cross * cross;
  if (discriminant < 0) return HUGE_VALL;
  return (dx * dx + dy * dy - s * s) / (std::sqrt(discriminant) - (dx * dvx + dy * dvy));
}

// Two disks at a distance given in units of reach, whose straight paths pass each other at `miss` times reach.
Relative towards(double distance, double miss, double reach, double angle, double speed) {
  const double along = std::sqrt(distance * distance - miss * miss) * reach;
  const double across = miss * reach;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * along - s * across, s * along + c * across, -speed * c, -speed * s};
}

TEST(ContactTime, HeadOn) {
  EXPECT_EQ(touching_time({5.0, 0.0, -2.0, 0.0}, 1.0), 2.0);
  EXPECT_EQ(touching_time({1.0, 0.0, -2.0, 0.0}, 1.0), 0.0);
  EXPECT_EQ(touching_time({0.5, 0.0, -2.0, 0.0}, 1.0), -0.25);
  EXPECT_EQ(touching_time({5.0, 2.0, -2.0, 0.0}, 1.0), HUGE_VAL);
}

// From touching to 1e9 reaches apart, from head-on to grazing within 1e-9, and overlapping. The error allowed is that
// of inputs rounded in the last place: eps t, and eps reach / speed over the square root of the distance from grazing.
TEST(ContactTime, KeepsItsDigitsFarAwayAndGrazing) {
  test::Draws draws(1);
  double worst = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const double reach = draws.decades(1e-3, 1e3);
    const double speed = draws.decades(1e-3, 1e3);
    const double gap = draws.decades(1e-9, 1.0);
    const double miss = 1.0 - gap;
    const double distance = k % 2 == 0 ? 1.0 + draws.decades(1e-6, 1e9) : draws.in(miss + 0.5 * gap, 1.0);
    const Relative r = towards(distance, miss, reach, draws.in(0.0, 2.0 * std::numbers::pi), speed);
    if (r.approach() >= 0.0) continue;
    const Wide exact = touching_time_with_more_digits(r, reach);
    if (std::isinf(exact)) continue;
    const double t = touching_time(r, reach);
    const double scale = std::abs(t) / std::sqrt(gap) + reach / speed / std::sqrt(gap);
    worst = std::max(worst, static_cast<double>(std::abs(static_cast<Wide>(t) - exact)) / scale);
  }
  EXPECT_LT(worst, 4.0 * 0x1p-52);
}

// Disks about to touch: the textbook form of the root, (-b - sqrt(b^2 - a c)) / a, loses digits, ours does not.
TEST(ContactTime, DoesNotCancelWhereTheTextbookFormDoes) {
  const Relative r{1.0 + 0x1p-40, 0.0, -1.0, 0.0};
  const double exact = 0x1p-40;
  EXPECT_NEAR(touching_time(r, 1.0) / exact, 1.0, 1e-12);
  const Relative slant = towards(1.0 + 1e-10, 0.3, 1.0, 0.7, 3.0);
  const double b = slant.approach();
  const double textbook = (-b - std::sqrt(b * b - slant.speed2() * (slant.distance2() - 1.0))) / slant.speed2();
  const auto digits = static_cast<double>(touching_time_with_more_digits(slant, 1.0));
  EXPECT_GT(std::abs(textbook / digits - 1.0), 1e-7);
  EXPECT_LT(std::abs(touching_time(slant, 1.0) / digits - 1.0), 1e-5);  // distance2 - 1 itself has only 6 digits
}

// After touching_time the distance is the sum of the radii, up to the rounding of the coordinates.
TEST(ContactTime, LeadsToContact) {
  test::Draws draws(3);
  for (int k = 0; k < 2000; ++k) {
    const Relative r = towards(draws.in(1.0, 20.0), draws.in(-0.999, 0.999), 2.0, draws.in(0.0, 6.0), 1.5);
    const double t = touching_time(r, 2.0);
    const double dx = r.dx + r.dvx * t;
    const double dy = r.dy + r.dvy * t;
    EXPECT_NEAR(std::sqrt(dx * dx + dy * dy), 2.0, 5e-14);
  }
}

struct Collision {
  Relative r;
  double m1, m2, e;
  double vx1, vy1, vx2, vy2;  // before the collision
  double wx1, wy1, wx2, wy2;  // after it
  double fast;                // the largest speed, before or after
};

Collision random_collision(test::Draws& draws, double mass_low, double mass_high) {
  Collision c{};
  c.m1 = draws.decades(mass_low, mass_high);
  c.m2 = draws.decades(mass_low, mass_high);
  c.e = draws.in(0.0, 1.0);
  do {
    const double angle = draws.in(0.0, 2.0 * std::numbers::pi);
    c.vx1 = draws.in(-1, 1), c.vy1 = draws.in(-1, 1), c.vx2 = draws.in(-1, 1), c.vy2 = draws.in(-1, 1);
    c.r = {std::cos(angle), std::sin(angle), c.vx2 - c.vx1, c.vy2 - c.vy1};
  } while (c.r.approach() >= 0.0);
  return c;
}

void apply(Collision& c) {
  c.wx1 = c.vx1, c.wy1 = c.vy1, c.wx2 = c.vx2, c.wy2 = c.vy2;
  const double change = collide(c.r, shares(c.m1, c.m2), c.e, c.wx1, c.wy1, c.wx2, c.wy2);
  EXPECT_NEAR(change, -(1.0 + c.e) * c.r.approach(), 1e-15);
  c.fast = std::max(
      {std::hypot(c.vx1, c.vy1), std::hypot(c.vx2, c.vy2), std::hypot(c.wx1, c.wy1), std::hypot(c.wx2, c.wy2)});
}

// For masses from 1e-6 to 1e6 and any e: momentum is conserved to the rounding of the two momenta, the normal velocity
// follows (22), and the tangential velocity does not change.
TEST(Collide, KeepsMomentumAndTangentialVelocityTurnsTheNormalOne) {
  test::Draws draws(4);
  for (int k = 0; k < 20000; ++k) {
    Collision c = random_collision(draws, 1e-6, 1e6);
    apply(c);
    const double p_scale = c.m1 * (std::hypot(c.vx1, c.vy1) + std::hypot(c.wx1, c.wy1)) +
                           c.m2 * (std::hypot(c.vx2, c.vy2) + std::hypot(c.wx2, c.wy2));
    EXPECT_LE(std::abs(c.m1 * (c.wx1 - c.vx1) + c.m2 * (c.wx2 - c.vx2)), 4.0 * 0x1p-52 * p_scale);
    EXPECT_LE(std::abs(c.m1 * (c.wy1 - c.vy1) + c.m2 * (c.wy2 - c.vy2)), 4.0 * 0x1p-52 * p_scale);
    const Relative after{c.r.dx, c.r.dy, c.wx2 - c.wx1, c.wy2 - c.wy1};
    EXPECT_NEAR(after.approach(), -c.e * c.r.approach(), 4e-15);
    const double across1 = c.r.dx * (c.wy1 - c.vy1) - c.r.dy * (c.wx1 - c.vx1);
    const double across2 = c.r.dx * (c.wy2 - c.vy2) - c.r.dy * (c.wx2 - c.vx2);
    EXPECT_NEAR(across1, 0.0, 2e-15);
    EXPECT_NEAR(across2, 0.0, 2e-15);
  }
}

// Elastic collisions conserve the kinetic energy. Others lower it by (1 - e^2) mu u_n^2 / 2, with mu the reduced mass.
TEST(Collide, EnergyFallsByTheFormula) {
  test::Draws draws(5);
  for (int k = 0; k < 20000; ++k) {
    Collision c = random_collision(draws, 1e-6, 1e6);
    if (k % 2 == 0) c.e = 1.0;
    apply(c);
    const double before = 0.5 * c.m1 * (c.vx1 * c.vx1 + c.vy1 * c.vy1) + 0.5 * c.m2 * (c.vx2 * c.vx2 + c.vy2 * c.vy2);
    const double after = 0.5 * c.m1 * (c.wx1 * c.wx1 + c.wy1 * c.wy1) + 0.5 * c.m2 * (c.wx2 * c.wx2 + c.wy2 * c.wy2);
    const double u = c.r.approach() / std::sqrt(c.r.distance2());
    const double lost = 0.5 * reduced_mass(c.m1, c.m2) * (1.0 - c.e * c.e) * u * u;
    EXPECT_NEAR((before - after - lost) / before, 0.0, 4e-15);
  }
}

// (17)-(19) and (23) of docs/original.md as written there, in more digits: rotate into the contact frame, change the
// normal components, rotate back.
void rule_as_printed(const Collision& c, Wide& wx1, Wide& wy1, Wide& wx2, Wide& wy2) {
  const Wide dx = wide(c.r.dx), dy = wide(c.r.dy), e = wide(c.e);
  const Wide vx1 = wide(c.vx1), vy1 = wide(c.vy1), vx2 = wide(c.vx2), vy2 = wide(c.vy2);
  const Wide d = std::sqrt(dx * dx + dy * dy);
  const Wide nx = dx / d, ny = dy / d;
  const Wide n1 = vx1 * nx + vy1 * ny, t1 = -vx1 * ny + vy1 * nx;
  const Wide n2 = vx2 * nx + vy2 * ny, t2 = -vx2 * ny + vy2 * nx;
  const Wide ratio = wide(c.m2) / wide(c.m1);
  const Wide n2_after = (n1 * (1 + e) + n2 * (ratio - e)) / (1 + ratio);
  const Wide n1_after = n1 + ratio * (n2 - n2_after);
  wx1 = n1_after * nx - t1 * ny, wy1 = n1_after * ny + t1 * nx;
  wx2 = n2_after * nx - t2 * ny, wy2 = n2_after * ny + t2 * nx;
}

TEST(Collide, IsRule23) {
  test::Draws draws(6);
  for (int k = 0; k < 20000; ++k) {
    Collision c = random_collision(draws, 1e-3, 1e3);
    apply(c);
    Wide wx1 = 0, wy1 = 0, wx2 = 0, wy2 = 0;
    rule_as_printed(c, wx1, wy1, wx2, wy2);
    EXPECT_NEAR(c.wx1, static_cast<double>(wx1), 1e-12 * c.fast);
    EXPECT_NEAR(c.wy1, static_cast<double>(wy1), 1e-12 * c.fast);
    EXPECT_NEAR(c.wx2, static_cast<double>(wx2), 1e-12 * c.fast);
    EXPECT_NEAR(c.wy2, static_cast<double>(wy2), 1e-12 * c.fast);
  }
}

// docs/reference_values.md, exact cases: m = 1 and 3, e = 1; the first disk flies along a line 0.5 above the second
// one's centre.
TEST(Collide, TwoDisksOfTheReferenceValues) {
  const double h = std::sqrt(0.75);
  double vx1 = 1.0, vy1 = 0.0, vx2 = 0.0, vy2 = 0.0;
  collide({h, -0.5, -1.0, 0.0}, shares(1.0, 3.0), 1.0, vx1, vy1, vx2, vy2);
  EXPECT_NEAR(vx1, -0.125, 1e-15);
  EXPECT_NEAR(vy1, 0.375 * std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(vy1, 0.649519053, 1e-9);
  EXPECT_NEAR(vx2, 0.375, 1e-15);
  EXPECT_NEAR(vy2, -0.216506351, 1e-9);
}

// Equal masses, e = 1: the normal components are exchanged (16), on the axes to the last bit.
TEST(Collide, EqualMassesSwap) {
  double vx1 = 0.75, vy1 = 0.5, vx2 = -0.25, vy2 = -1.0;
  collide({2.0, 0.0, -1.0, -1.5}, equal_shares, 1.0, vx1, vy1, vx2, vy2);
  EXPECT_EQ(vx1, -0.25);
  EXPECT_EQ(vx2, 0.75);
  EXPECT_EQ(vy1, 0.5);
  EXPECT_EQ(vy2, -1.0);
}

TEST(Touches, ContactIncluded) {
  EXPECT_TRUE(touches(4.0, 2.0));
  EXPECT_TRUE(touches(3.9, 2.0));
  EXPECT_FALSE(touches(std::nextafter(4.0, 5.0), 2.0));
}

}  // namespace
}  // namespace carom
