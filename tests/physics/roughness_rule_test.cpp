// The rule of rough disks, computed by hand for one contact at a time.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/same_bits.hpp"
#include "core/physics/roughness.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

// Two disks that touch, and their state after a collision.
struct Pair {
  double x1 = 0.0, y1 = 0.0, x2 = 2.0, y2 = 0.0;
  double r1 = 1.0, r2 = 1.0, m1 = 1.0, m2 = 1.0;
  double vx1 = 0.0, vy1 = 0.0, vx2 = 0.0, vy2 = 0.0, w1 = 0.0, w2 = 0.0;

  Relative relative() const { return {x2 - x1, y2 - y1, vx2 - vx1, vy2 - vy1}; }
  // The velocity of the second disk's surface along the first one's, counter-clockwise around the first disk.
  double slip() const {
    const Relative r = relative();
    return (r.dx * r.dvy - r.dy * r.dvx) / std::sqrt(r.distance2()) - (r1 * w1 + r2 * w2);
  }
  double momentum_x() const { return m1 * vx1 + m2 * vx2; }
  double momentum_y() const { return m1 * vy1 + m2 * vy2; }
  // The angular momentum about (x, y).
  double angular_momentum(double x, double y, double q) const {
    const double orbital = m1 * ((x1 - x) * vy1 - (y1 - y) * vx1) + m2 * ((x2 - x) * vy2 - (y2 - y) * vx2);
    return orbital + q * (m1 * r1 * r1 * w1 + m2 * r2 * r2 * w2);
  }
  double energy(double q) const {
    return 0.5 * (m1 * (vx1 * vx1 + vy1 * vy1) + m2 * (vx2 * vx2 + vy2 * vy2)) + rotational_energy(q, m1, r1, w1) +
           rotational_energy(q, m2, r2, w2);
  }
};

Pair collided(Pair p, const Surfaces& surfaces, double e) {
  const Relative r = p.relative();
  const Shares share = shares(p.m1, p.m2);
  const double change = collide(r, share, e, p.vx1, p.vy1, p.vx2, p.vy2);
  rub_disks(surfaces, r, share, change, {p.r1, p.vx1, p.vy1, p.w1}, {p.r2, p.vx2, p.vy2, p.w2});
  return p;
}

Surfaces rough(double b, double mu = HUGE_VAL, double q = 0.5) {
  return {q, {b, mu}, {}};
}

// A slip of -3 is reversed by an impulse of 2 (1/3) 3 = 2 reduced masses, which acts on both disks.
TEST(RoughPair, HeadOnWithSpin) {
  Pair p;
  p.vx1 = 1.0;
  p.vx2 = -1.0;
  p.w1 = 3.0;
  const Pair after = collided(p, rough(1.0), 1.0);
  EXPECT_DOUBLE_EQ(after.vx1, -1.0);
  EXPECT_DOUBLE_EQ(after.vx2, 1.0);
  EXPECT_DOUBLE_EQ(after.vy1, -1.0);
  EXPECT_DOUBLE_EQ(after.vy2, 1.0);
  EXPECT_DOUBLE_EQ(after.w1, 1.0);
  EXPECT_DOUBLE_EQ(after.w2, -2.0);
}

// With b = 0 the slip stops, as for two wheels that touch.
TEST(RoughPair, WithoutTangentialRestitutionTheSlipStops) {
  Pair p;
  p.vx1 = 1.0;
  p.vy1 = 0.75;
  p.w2 = 2.0;
  EXPECT_NE(p.slip(), 0.0);
  EXPECT_NEAR(collided(p, rough(0.0), 0.5).slip(), 0.0, 1e-15);
}

// A grazing collision slides: the normal speed is 0.01, so the tangential impulse is mu (1 + e) 0.01 reduced masses.
TEST(RoughPair, GrazingSlides) {
  Pair p;
  p.vx1 = 0.01;
  p.vy1 = 10.0;
  const Pair after = collided(p, rough(0.5, 0.25), 0.6);
  const double k = 0.25 * 1.6 * 0.01;
  EXPECT_NEAR(after.vy2, 0.5 * k, 1e-17);
  EXPECT_NEAR(after.vy1, 10.0 - 0.5 * k, 1e-14);
  EXPECT_NEAR(after.w1, -k, 1e-17);
  EXPECT_NEAR(after.w2, -k, 1e-17);
}

// Sticking needs an impulse of (1 + b) q / (1 + q) slip. With a coefficient of friction a little above its ratio to the
// normal impulse the contact sticks, with one a little below it slides.
TEST(RoughPair, SticksOrSlidesByFriction) {
  Pair p;
  p.vx1 = 1.0;
  p.vy1 = -0.5;
  const double b = 0.4, q = 0.4, e = 0.8;
  const double asked = (1.0 + b) * q / (1.0 + q) * 0.5;
  const double border = asked / ((1.0 + e) * 1.0);
  const Pair sticking = collided(p, rough(b, 1.001 * border, q), e);
  const Pair sliding = collided(p, rough(b, 0.5 * border, q), e);
  EXPECT_NEAR(sticking.slip(), -b * p.slip(), 1e-15);
  EXPECT_NEAR(sliding.vy2, -0.25 * asked, 1e-15);
  EXPECT_GT(sliding.slip(), 0.0) << "sliding must not reverse the slip";
}

// For any sizes, masses and spins: momentum and angular momentum about any point are conserved, the slip becomes -b
// times what it was, and the energy lost is (1 - b^2) / 2 of the slip squared times the reduced mass and q / (1 + q).
TEST(RoughPair, Conserves) {
  test::Draws draws(3);
  for (int k = 0; k < 2000; ++k) {
    const double q = draws.in(0.05, 1.0), b = draws.in(-1.0, 1.0), e = draws.in(0.0, 1.0);
    Pair p;
    p.r1 = draws.in(0.2, 3.0);
    p.r2 = draws.in(0.2, 3.0);
    p.m1 = draws.in(0.1, 9.0);
    p.m2 = draws.in(0.1, 9.0);
    const double angle = draws.in(0.0, 6.28);
    p.x2 = p.x1 + (p.r1 + p.r2) * std::cos(angle);
    p.y2 = p.y1 + (p.r1 + p.r2) * std::sin(angle);
    for (double* v : {&p.vx1, &p.vy1, &p.vx2, &p.vy2, &p.w1, &p.w2}) *v = draws.in(-2.0, 2.0);
    if (!(p.relative().approach() < 0.0)) continue;
    const bool slides = k % 2 == 0;
    const Pair after = collided(p, rough(b, slides ? draws.in(0.0, 0.5) : HUGE_VAL, q), e);
    EXPECT_NEAR(after.momentum_x(), p.momentum_x(), 1e-13);
    EXPECT_NEAR(after.momentum_y(), p.momentum_y(), 1e-13);
    for (const double x : {0.0, -7.0, 3.5}) {
      EXPECT_NEAR(after.angular_momentum(x, 2.0 * x, q), p.angular_momentum(x, 2.0 * x, q), 1e-11);
    }
    EXPECT_LE(after.energy(q), p.energy(q) * (1.0 + 1e-14));
    if (slides) continue;
    EXPECT_NEAR(after.slip(), -b * p.slip(), 1e-12);
    const double reduced = p.m1 * p.m2 / (p.m1 + p.m2);
    const double normal = p.relative().approach() / std::sqrt(p.relative().distance2());
    const double lost =
        0.5 * reduced * ((1.0 - e * e) * normal * normal + q / (1.0 + q) * (1.0 - b * b) * p.slip() * p.slip());
    EXPECT_NEAR(p.energy(q) - after.energy(q), lost, 1e-11);
  }
}

// Without a limit to friction a contact sticks however lightly it is pressed: (1 + b) q / (1 + q) of the slip is
// reversed. With a limit a contact without pressure slides freely.
TEST(Rub, SticksWithoutBeingPressed) {
  for (const double pressed : {0.0, 1e-300, 1.0}) {
    EXPECT_DOUBLE_EQ(rub({0.5, HUGE_VAL}, 0.5, 2.0, pressed), -1.0) << pressed;
  }
  EXPECT_EQ(rub({0.5, 0.3}, 0.5, 2.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(rub({0.5, 0.3}, 0.5, 2.0, 1.0), -0.3);
  EXPECT_DOUBLE_EQ(rub({0.5, 0.3}, 0.5, -2.0, 1.0), 0.3);
}

// Surfaces that are smooth by b = -1 or by mu = 0 leave all velocities with the same bits as the rule without
// roughness, including the signs of zeros.
TEST(RoughPair, SmoothSurfacesChangeNoBit) {
  test::Draws draws(4);
  for (int k = 0; k < 1000; ++k) {
    Pair p;
    p.vx1 = draws.in(0.1, 2.0);
    if (k % 2 == 0) p.vy1 = draws.in(-2.0, 2.0);
    p.vy2 = -0.0;
    p.w1 = draws.in(-2.0, 2.0);
    Pair plain = p;
    collide(p.relative(), equal_shares, 0.7, plain.vx1, plain.vy1, plain.vx2, plain.vy2);
    for (const Surfaces& smooth : {rough(-1.0), rough(-1.0, 0.3), rough(0.5, 0.0)}) {
      const Pair after = collided(p, smooth, 0.7);
      EXPECT_TRUE(same_bits(after.vx1, plain.vx1) && same_bits(after.vy1, plain.vy1));
      EXPECT_TRUE(same_bits(after.vx2, plain.vx2) && same_bits(after.vy2, plain.vy2));
      EXPECT_TRUE(same_bits(after.w1, p.w1) && same_bits(after.w2, p.w2));
    }
  }
}

// A disk flies along a floor without spin, and b = 0 makes it roll: with q = 1/2 its speed becomes 2/3 of what it was,
// its surface is at rest on the floor, and it turns clockwise if it moves to the right.
TEST(RoughWall, BringsADiskToRoll) {
  double vx = 3.0, vy = 1.0, w = 0.0;
  rub_wall({0.0, HUGE_VAL}, 0.5, {0.0, 1.0}, 2.0, {2.0, vx, vy, w});
  EXPECT_DOUBLE_EQ(vx, 2.0);
  EXPECT_EQ(vy, 1.0);
  EXPECT_DOUBLE_EQ(w, -1.0);
  EXPECT_DOUBLE_EQ(vx + 2.0 * w, 0.0);
}

// The same for every side, rotated; and sliding, where the speed lost is mu times the change of the normal speed.
TEST(RoughWall, IsTheSameInAnyDirection) {
  for (const double angle : {0.3, 1.7, 3.2, 5.0}) {
    const double nx = std::cos(angle), ny = std::sin(angle);
    const double along_x = ny, along_y = -nx;  // clockwise from the normal: on a floor, to the right
    double vx = 3.0 * along_x + nx, vy = 3.0 * along_y + ny, w = 0.0;
    rub_wall({0.0, HUGE_VAL}, 0.5, {nx, ny}, 2.0, {2.0, vx, vy, w});
    EXPECT_NEAR(vx * along_x + vy * along_y, 2.0, 1e-14);
    EXPECT_NEAR(vx * nx + vy * ny, 1.0, 1e-14);
    EXPECT_NEAR(w, -1.0, 1e-14);
    vx = 3.0 * along_x, vy = 3.0 * along_y, w = 0.0;
    rub_wall({0.5, 0.1}, 0.5, {nx, ny}, 2.0, {2.0, vx, vy, w});
    EXPECT_NEAR(vx * along_x + vy * along_y, 2.8, 1e-14);
    EXPECT_NEAR(w, -0.2, 1e-14);
  }
}

}  // namespace
}  // namespace carom
