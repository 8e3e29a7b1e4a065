// Draws of sources and the figures used to plan for them: places along a side, independent speeds, the rate of sources
// that are not exhausted, and the largest disk to come.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check.hpp"
#include "core/scene/scene_ranges.hpp"
#include "core/step/source.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr double radius = 0.5, width = 30.0, height = 20.0;

// Disks of mass 4 enter through the left side.
Scene scene_with_source() {
  Scene s = test::scene_of(Method::pairwise, width, height, 0.1, 1.0);
  Source source;
  source.rate = 2.0;
  source.radius.value = radius;
  source.mass.value = 4.0;
  source.side = Side::left;
  source.velocities.kind = VelocityLaw::Kind::maxwell;
  source.velocities.temperature = 2.0;
  s.sources = {source};
  return s;
}

// The whole side up to periodic ends, and up to a radius from walls.
TEST(EmissionPlace, IsAnywhereAlongTheSide) {
  for (const Side side : all_sides) {
    const bool upright = side == Side::left || side == Side::right;
    const double length = upright ? height : width;
    for (const bool periodic : {false, true}) {
      Scene s = scene_with_source();
      s.sources[0].side = side;
      for (const Side along : all_sides) {
        const bool is_end = upright != (along == Side::left || along == Side::right);
        s.box.sides[static_cast<std::size_t>(along)] = is_end && periodic ? SideKind::periodic : SideKind::wall;
      }
      double lowest = length, highest = 0.0;
      for (DiskId id = 0; id < 5000; ++id) {
        const Disk disk = draw_emission(s, s.box, 0, id, id, 0);
        lowest = std::min(lowest, upright ? disk.y : disk.x);
        highest = std::max(highest, upright ? disk.y : disk.x);
      }
      const double margin = periodic ? 0.0 : radius;
      EXPECT_TRUE(lowest >= margin && lowest < margin + 0.1) << lowest;
      EXPECT_TRUE(highest <= length - margin && highest > length - margin - 0.1) << highest;
    }
  }
}

// A normal deviate is larger in absolute value than a Rayleigh deviate in 1 - 1 / sqrt(2) of all draws.
TEST(EmissionSpeed, AlongTheSideKnowsNothingOfThatThroughIt) {
  const Scene s = scene_with_source();
  constexpr int n = 20000;
  int slanting = 0;
  for (DiskId id = 0; id < n; ++id) {
    const Disk d = draw_emission(s, s.box, 0, id, id, 3);
    slanting += std::abs(d.vy) > d.vx ? 1 : 0;
  }
  const double share = 1.0 - std::numbers::sqrt2 / 2.0;
  EXPECT_NEAR(static_cast<double>(slanting) / n, share, 4.0 * std::sqrt(share * (1.0 - share) / n));
}

// A moving side has come in since the start: the disk touches it where it is now, and has its speed in addition.
TEST(EmissionPlace, IsWhereASideThatMovesIsThen) {
  Scene s = scene_with_source();
  SideMotion& motion = s.box.motions[static_cast<std::size_t>(Side::left)];
  motion.kind = SideMotion::Kind::steady;
  motion.speed = 0.75;
  motion.furthest = 3.0;
  s.sources[0].velocities = {};
  State state;
  state.sources.resize(1);
  emit_due(s, state, 2.0, 7, [](const Disk&) { return true; });
  ASSERT_EQ(state.disks.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(state.disks.x[i], 1.5 + radius);
    EXPECT_EQ(state.disks.vx[i], 0.75);
  }
}

TEST(EmissionRate, IsOfThoseThatHaveMore) {
  Scene s = scene_with_source();
  s.sources.push_back(s.sources.front());
  s.sources[0].limit = 10;
  State state;
  state.sources = {{9}, {1000}};
  EXPECT_EQ(emission_rate(s, state), 4.0);
  state.sources[0].emitted = 10;
  EXPECT_EQ(emission_rate(s, state), 2.0);
}

TEST(LargestOfASource, FollowsFromItsMassWhereItsRadiusDoes) {
  Source source = scene_with_source().sources.front();
  EXPECT_EQ(largest_radius_of(source), radius);
  source.mass.value = 9.0 * std::numbers::pi;
  source.radius.kind = SizeLaw::Kind::from_other;
  source.radius.density = 4.0;
  EXPECT_NEAR(largest_radius_of(source), 1.5, 1e-12);
}

// A disk that is due exactly at the end does not come any more.
TEST(EmissionsDue, BeforeATimeAreThoseOfEarlierOnes) {
  Source source;
  source.rate = 2.0;
  EXPECT_EQ(due_by(source, 5.0), 10U);
  EXPECT_EQ(due_before(source, 5.0), 9U);
  EXPECT_EQ(due_before(source, 5.1), 10U);
  source.limit = 4;
  EXPECT_EQ(due_before(source, 5.0), 4U);
}

TEST(EmissionIds, HaveAnEnd) {
  const Scene s = scene_with_source();
  const auto room = [](const Disk&) { return true; };
  State state;
  state.sources.resize(1);
  state.next_id = static_cast<DiskId>(most_disks - 1);
  EXPECT_NO_THROW(emit_from_source(s, s.box, state, 0, 1, 0, {}, room));
  EXPECT_THROW(emit_from_source(s, s.box, state, 0, 2, 0, {}, room), PhysicsError);
  EXPECT_EQ(state.disks.size(), 1U);
}

}  // namespace
}  // namespace carom
