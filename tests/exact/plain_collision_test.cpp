// The collision of two disks that computes x and y together, compared with core's formula bit by bit.
#include "parallel/exact/plain_collision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/physics/exact_event.hpp"
#include "core/physics/restitution.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

PathSegment drawn_path(test::Draws& draws, double far) {
  return {draws.in(0.0, 1.0), draws.in(-far, far), draws.in(-far, far), draws.in(-2.0, 2.0), draws.in(-2.0, 2.0)};
}

void expect_same(const PathSegment& a, const PathSegment& b) {
  // The bits include the signs of zeros.
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(bits(a.x), bits(b.x));
  EXPECT_EQ(bits(a.y), bits(b.y));
  EXPECT_EQ(bits(a.vx), bits(b.vx));
  EXPECT_EQ(bits(a.vy), bits(b.vy));
}

// A restitution that depends on the relative motion of the two disks.
double drawn_restitution(const Relative& r) {
  return 1.0 / (1.0 + speed_of_approach(r));
}

// flight: must equal core's drift<falls> with this gravity. Returns the number of collisions.
template <bool falls, class Flight>
int expect_bits_of_the_formula(const Gravity& gravity, const Flight& flight) {
  test::Draws draws(23);
  int happened = 0;
  for (int round = 0; round < 2000; ++round) {
    PathSegment p = drawn_path(draws, 8.0);
    PathSegment q = drawn_path(draws, 8.0);
    // Some pairs recede, some have no relative velocity, some are at one place; some velocities are zeros of both
    // signs.
    if (round % 10 == 0) q.vx = p.vx, q.vy = p.vy;
    if (round % 50 == 0) q = p;
    if (round % 7 == 0) p.vx = -0.0, q.vy = -0.0;
    if (round % 7 == 1) p.vy = 0.0, q.vx = 0.0;
    const double s = round % 11 == 0 ? p.start = q.start : draws.in(1.0, 2.0);
    const Shares share = round % 2 == 0 ? equal_shares : shares(draws.in(0.1, 1.0), draws.in(0.1, 10.0));
    PathSegment core_p = p;
    PathSegment core_q = q;
    const PairImpact impact =
        collide_paths<falls, false>(Domain{}, gravity, s, share, 1.0, drawn_restitution, core_p, core_q);
    const PlainCollision outcome = collide_plainly(s, flight, share, drawn_restitution, p, q);
    happened += impact.happened ? 1 : 0;
    EXPECT_EQ(outcome.happened, impact.happened);
    EXPECT_EQ(outcome.change, impact.virial);
    EXPECT_EQ(outcome.fastest2, std::max(p.vx * p.vx + p.vy * p.vy, q.vx * q.vx + q.vy * q.vy));
    expect_same(p, core_p);
    expect_same(q, core_q);
  }
  return happened;
}

TEST(PlainCollision, HasTheBitsOfTheFormula) {
  const int happened = expect_bits_of_the_formula<false>(0.0, FreeFlight{});
  EXPECT_GT(happened, 500);
  EXPECT_LT(happened, 1500);
}

// Gravity along y only, upwards, too, and in any direction. Without gravity a fall is a straight path.
TEST(PlainCollision, HasTheBitsOfTheFormulaUnderGravity) {
  for (const Gravity& g : {Gravity(0.7), Gravity(-0.7), Gravity(-0.0, 0.7), Gravity(0.5, -0.4), Gravity(-0.5, 0.4),
                           Gravity(0.3, 0.0), Gravity(-0.3, -0.0)}) {
    const int happened = expect_bits_of_the_formula<true>(g, FreeFall(g));
    EXPECT_GT(happened, 500);
    EXPECT_LT(happened, 1500);
  }
  expect_bits_of_the_formula<false>(0.0, FreeFall(0.0));
}

// If the inner part contains two disks, images and borders do not matter. It contains most of the disks that are not
// near a border, and none that is across one.
TEST(PlainCollision, IsTheSameAsAcrossBordersInTheInnerPart) {
  test::Draws draws(24);
  for (const bool along_x : {false, true}) {
    Domain box;
    box.width = 6.0;
    box.height = 4.0;
    box.sides.fill(SideKind::wall);
    if (along_x) {
      box.sides[static_cast<std::size_t>(Side::left)] = box.sides[static_cast<std::size_t>(Side::right)] =
          SideKind::periodic;
    } else {
      box.sides.fill(SideKind::periodic);
    }
    const InnerPart inner(box);
    int held = 0;
    for (int round = 0; round < 3000; ++round) {
      PathSegment p = drawn_path(draws, 4.0);
      PathSegment q = drawn_path(draws, 4.0);
      p.x += 3.0, q.x += 3.0;
      p.y += 2.0, q.y += 2.0;
      const double s = draws.in(1.0, 1.5);
      if (!inner.holds(s, FreeFlight{}, p, q)) continue;
      ++held;
      PathSegment core_p = p;
      PathSegment core_q = q;
      collide_paths<false>(
          box, 0.0, s, equal_shares, 1.0, [](const Relative&) { return 1.0; }, core_p, core_q);
      collide_plainly(s, FreeFlight{}, equal_shares, ConstantRestitution{1.0}, p, q);
      expect_same(p, core_p);
      expect_same(q, core_q);
    }
    EXPECT_GT(held, 200);
    EXPECT_FALSE(inner.holds(1.0, FreeFlight{}, {1.0, 0.1, 2.0, 0.0, 0.0}, {1.0, 5.9, 2.0, 0.0, 0.0}));
    EXPECT_FALSE(inner.holds(1.0, FreeFlight{}, {1.0, 6.0, 2.0, 0.0, 0.0}, {1.0, 5.9, 2.0, 0.0, 0.0}));
    EXPECT_EQ(inner.holds(1.0, FreeFlight{}, {1.0, 1.0, -0.1, 0.0, 0.0}, {1.0, 1.0, 0.9, 0.0, 0.0}), along_x);
  }
}

}  // namespace
}  // namespace carom
