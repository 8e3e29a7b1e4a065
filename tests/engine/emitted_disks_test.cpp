// Disks drawn by a source: their places, speeds, spins and energy, and how many of the waiting ones come.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/physics/boundary.hpp"
#include "core/step/source.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/source_by_hand.hpp"

namespace carom {
namespace {

// For each side: the disk touches it, is inside the box, and moves inwards.
TEST(Emission, ThroughASideTouchesItAndMovesInward) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  for (Side side : all_sides) {
    Source source = test::source_of(1.0, 0.5);
    source.side = side;
    source.velocities.kind = side == Side::left ? VelocityLaw::Kind::uniform : VelocityLaw::Kind::maxwell;
    source.velocities.temperature = 2.0;
    source.velocities.limit = 3.0;
    s.sources = {source};
    for (DiskId id = 0; id < 200; ++id) {
      const Disk d = draw_emission(s, s.box, 0, id, id, id);
      EXPECT_EQ(reach_beyond(side, d.x, d.y, d.radius, s.box), 0.0);
      EXPECT_LT(outward_speed(side, d.vx, d.vy), 0.0);
      for (Side other : all_sides) EXPECT_LE(reach_beyond(other, d.x, d.y, d.radius, s.box), 1e-14);
    }
  }
}

// A gas behind a hole: the distribution of the normal speed is weighted with the speed, with density m v / T exp(-m v^2
// / 2 T), mean sqrt(pi T / 2 m), and variance (2 - pi / 2) T / m; the tangential velocity is a normal deviate of
// variance T / m. The tolerance is 4 standard errors.
TEST(Emission, MaxwellIsThatOfAGasBehindAHole) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  Source source = test::source_of(1.0, 0.5);
  source.side = Side::left;
  source.mass.value = 4.0;
  source.velocities.kind = VelocityLaw::Kind::maxwell;
  source.velocities.temperature = 2.0;
  s.sources = {source};
  constexpr int n = 20000;
  double inward = 0.0;
  double across = 0.0;
  for (DiskId id = 0; id < n; ++id) {
    const Disk d = draw_emission(s, s.box, 0, id, id, 3);
    inward += d.vx / n;
    across += d.vy * d.vy / n;
  }
  const double unit = std::sqrt(2.0 / 4.0);
  EXPECT_NEAR(inward / unit, std::sqrt(0.5 * std::numbers::pi), 4.0 * std::sqrt((2.0 - 0.5 * std::numbers::pi) / n));
  EXPECT_NEAR(across / (unit * unit), 1.0, 4.0 * std::sqrt(2.0 / n));
}

// Each source draws from a stream of its own.
TEST(Emission, SourcesDiffer) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  Source source = test::source_in({1.0, 1.0}, {29.0, 19.0}, 1.0, 0.5);
  s.sources = {source, source};
  EXPECT_NE(draw_emission(s, s.box, 0, 5, 0, 0).x, draw_emission(s, s.box, 1, 5, 0, 0).x);
  EXPECT_NE(draw_emission(s, s.box, 0, 5, 0, 0).x, draw_emission(s, s.box, 0, 5, 0, 1).x);
  EXPECT_EQ(draw_emission(s, s.box, 0, 5, 0, 0).x, draw_emission(s, s.box, 0, 5, 0, 0).x);
}

// Disks come in along the whole side, between the adjacent sides as they are now; if the side moves, velocities are
// drawn in its frame.
TEST(Emission, ThroughASideStaysBetweenThoseThatHaveMoved) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  Source source = test::source_of(1.0, 0.5);
  source.side = Side::left;
  source.velocities.kind = VelocityLaw::Kind::uniform;
  source.velocities.limit = 1.0;
  s.sources = {source};
  Domain box = s.box;
  box.places = {SidePlace{2.0, 5.0, 0.0}, SidePlace{}, SidePlace{6.0, 0.0, 0.0}, SidePlace{3.0, 0.0, 0.0}};
  double least = 20.0, most = 0.0;
  for (DiskId id = 0; id < 400; ++id) {
    const Disk d = draw_emission(s, box, 0, id, id, id);
    EXPECT_EQ(d.x, 2.5);
    EXPECT_GE(d.vx, 5.0) << "the side comes in at 5";
    EXPECT_LE(d.vx, 6.0);
    least = std::min(least, d.y);
    most = std::max(most, d.y);
  }
  EXPECT_GE(least, 6.5);
  EXPECT_LE(most, 16.5);
  EXPECT_NEAR(most - least, 10.0, 0.2) << "the range of 400 places";
}

// I w^2 has the mean T; the tolerance is 4 standard errors of the mean of n squares of normal deviates.
TEST(Emission, SpinsAreThoseOfTheirTemperature) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  s.physics.surfaces.inertia = 0.3;
  Source source = test::source_of(1.0, 0.5);
  source.mass.value = 4.0;
  source.spins.temperature = 2.0;
  source.region_low = {1.0, 1.0};
  source.region_high = {29.0, 19.0};
  s.sources = {source};
  constexpr int n = 20000;
  double twice_energy = 0.0;
  for (DiskId id = 0; id < n; ++id) {
    const Disk d = draw_emission(s, s.box, 0, id, id, 3);
    twice_energy += 0.3 * d.mass * d.radius * d.radius * d.spin * d.spin / n;
  }
  EXPECT_NEAR(twice_energy / 2.0, 1.0, 4.0 * std::sqrt(2.0 / n));
}

// The energy of new disks includes that of translation, position and rotation.
TEST(Emission, EnergyOfNewDisksIsCounted) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  s.physics.gravity = Gravity(0.25, 0.5);
  s.physics.surfaces.inertia = 0.5;
  Source source = test::source_of(1.0, 0.1);
  source.velocities.kind = VelocityLaw::Kind::uniform;
  source.velocities.limit = 1.0;
  source.spins.value = 7.0;
  source.region_low = {1.0, 1.0};
  source.region_high = {29.0, 19.0};
  s.sources = {source};
  State state = test::state_of(s, {});
  state.disks.inertia = 0.5;
  emit_from_source(s, s.box, state, 0, 20, 0, {}, [](const Disk&) { return true; });
  ASSERT_EQ(state.disks.size(), 20U);
  const Energy energy = energy_of(state.disks, s.physics.gravity);
  EXPECT_GT(energy.potential, 0.0);
  EXPECT_NEAR(energy.rotational, 20.0 * 0.5 * 0.5 * 0.7 * 0.7, 1e-12) << "I w^2 / 2";
  EXPECT_NEAR(state.counters.emitted_energy, energy.total(), 1e-12 * energy.total());
}

// The number of waiting disks is summed over the sources.
TEST(Emission, DisksOfAllSourcesWait) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 10.0);
  Source source = test::source_in({1.0, 1.0}, {29.0, 19.0}, 1.0, 0.5);
  s.sources = {source, source};
  s.sources[1].rate = 2.0;
  State state = test::state_of(s, {});
  emit_due(s, state, 3.0, 30, [](const Disk&) { return false; });
  EXPECT_EQ(state.counters.waiting, 3U + 6U);
}

// A region may come closer to a wall than a radius: a disk drawn there has to wait, at each of the four walls.
TEST(Emission, FromARegionIsWithinAllWalls) {
  Scene s = test::scene_of(Method::pairwise, 6.0, 4.0, 0.1, 6.0);
  const auto anywhere = [](const Disk&) { return true; };
  for (const auto& [low, high] :
       {std::pair{Vec2{0.0, 1.9}, Vec2{0.3, 2.1}}, std::pair{Vec2{5.7, 1.9}, Vec2{6.0, 2.1}},
        std::pair{Vec2{2.9, 0.0}, Vec2{3.1, 0.3}}, std::pair{Vec2{2.9, 3.7}, Vec2{3.1, 4.0}}}) {
    Source source = test::source_in(low, high, 1.0, 0.25);
    s.sources = {source};
    State state = test::state_of(s, {});
    for (Count step = 1; step <= 100; ++step) emit_due(s, state, static_cast<double>(step), step, anywhere);
    EXPECT_GE(state.disks.size(), 5U);
    for (std::size_t i = 0; i < state.disks.size(); ++i) {
      EXPECT_GE(state.disks.x[i], 0.25);
      EXPECT_LE(state.disks.x[i], 5.75);
      EXPECT_GE(state.disks.y[i], 0.25);
      EXPECT_LE(state.disks.y[i], 3.75);
    }
  }
}

// In binary numbers 3.3 - 1.1 is less than 2.2; such a scene was once refused, as if there were no room.
TEST(Emission, FromAPlaceThatTouchesAWallInDecimals) {
  const Scene s = parse_scene(
      "[box]\nwidth = 3.3\nheight = 9.0\n[[sources]]\nregion = [2.2, 2.0, 2.2, 2.0]\nrate = 10.0\nlimit = 1\n"
      "radius = 1.1\nmass = 1.0\n[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1.0\n",
      "decimals.toml", "");
  State state = test::state_of(s, {});
  emit_due(s, state, 0.5, 50, [](const Disk&) { return true; });
  ASSERT_EQ(state.disks.size(), 1U);
  EXPECT_EQ(state.disks.x[0], 2.2);
}

// If there is room for all waiting disks at once, still no more come than the limit.
TEST(Emission, OfThoseThatWaitedNoMoreComeThanTheLimit) {
  Scene s = test::scene_of(Method::exact, 30.0, 20.0, 0.1, 9.0);
  Source source = test::source_in({1.0, 1.0}, {29.0, 19.0}, 1.0, 0.5);
  source.limit = 2;
  s.sources = {source};
  State state = test::state_of(s, {});
  emit_from_source(s, s.box, state, 0, 5, 5, {}, [](const Disk&) { return true; });
  EXPECT_EQ(state.disks.size(), 2U);
  EXPECT_EQ(state.counters.waiting, 0U);
}

}  // namespace
}  // namespace carom
