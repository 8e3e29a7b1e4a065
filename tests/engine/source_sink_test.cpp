// Disks that come and go: rates, room, limits, sinks, identities.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/physics/boundary.hpp"
#include "core/step/source.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

SizeLaw constant(double value) {
  SizeLaw law;
  law.value = value;
  return law;
}

Source source_of(double rate, double radius) {
  Source source;
  source.rate = rate;
  source.radius = constant(radius);
  source.mass = constant(1.0);
  return source;
}

class SourceSink : public testing::TestWithParam<Method> {
 protected:
  Scene scene(double dt, double t_end) const { return test::scene_of(GetParam(), 100.0, 100.0, dt, t_end); }
};

INSTANTIATE_TEST_SUITE_P(Methods, SourceSink, testing::ValuesIn(test::stepping_methods),
                         [](const auto& method) { return test::name_of(method.param); });

// The k-th disk comes at k / rate, also where rate * (k / rate) is rounded below k.
TEST(SourceRate, TheKthDiskIsDueAtKOverRate) {
  for (const double rate : {49.0, 3.0, 0.7, 1e-3, 1e5}) {
    Source source;
    source.rate = rate;
    for (Count k = 1; k < 2000; ++k) {
      const double t = static_cast<double>(k) / rate;
      ASSERT_EQ(due_by(source, t), k) << rate;
      ASSERT_EQ(due_by(source, std::nextafter(t, 0.0)), k - 1) << rate;
    }
  }
}

// The k-th disk is due at k / rate: with room for all, after every step floor(rate t) are there, t the step's start.
TEST_P(SourceSink, EmitsAtItsRate) {
  Scene s = scene(0.1, 20.0);
  Source source = source_of(7.0, 0.1);
  source.region_low = {1.0, 1.0};
  source.region_high = {99.0, 99.0};
  s.sources.push_back(source);
  double began = 0.0;
  const State end = test::run(s, test::state_of(s, {}), [&](const Engine& engine) {
    EXPECT_EQ(engine.state().counters.emitted + engine.state().counters.waiting,
              static_cast<Count>(std::floor(7.0 * began)));
    began = engine.state().time;
  });
  EXPECT_EQ(end.counters.emitted, end.disks.size());
  EXPECT_GE(end.counters.emitted, 135U);
  EXPECT_EQ(end.next_id, end.counters.emitted);
}

// A disk that leaves through a sink was there up to then, to half a step: rates are per disk that was there.
TEST_P(SourceSink, CountsHowLongDisksAreThere) {
  constexpr double dt = 0.25;
  Scene s = scene(dt, 64.0);
  s.box.sides[static_cast<std::size_t>(Side::left)] = SideKind::sink;
  const State start = test::state_of(s, {{11.0, 20.0, -1.0, 0.0, 1.0, 1.0},   // leaves at 10
                                         {41.0, 40.0, -2.0, 0.0, 1.0, 1.0},   // at 20
                                         {50.0, 80.0, 0.0, 0.0, 1.0, 1.0}});  // stays
  const State end = test::run(s, start);
  EXPECT_EQ(end.counters.removed, 2U);
  EXPECT_EQ(end.taken[sink_number(Side::left)], 2U);
  EXPECT_NEAR(end.counters.disk_time, 10.0 + 20.0 + 64.0, 2.0 * dt);
}

// The same of exact, to the time at which a sink takes it, whatever the windows; on any number of threads.
TEST(ExactSink, CountsHowLongDisksAreThere) {
  Scene s = test::scene_of(Method::exact, 100.0, 100.0, 0.25, 64.0);
  s.box.sides[static_cast<std::size_t>(Side::left)] = SideKind::sink;
  const State start = test::state_of(
      s, {{11.0, 20.0, -1.0, 0.0, 1.0, 1.0}, {41.0, 40.0, -2.0, 0.0, 1.0, 1.0}, {50.0, 80.0, 0.0, 0.0, 1.0, 1.0}});
  const State end = test::run(s, start);
  EXPECT_EQ(end.counters.removed, 2U);
  EXPECT_EQ(end.taken[sink_number(Side::left)], 2U);
  EXPECT_NEAR(end.counters.disk_time, 10.0 + 20.0 + 64.0, 1e-12);
  for (const int threads : {1, 3}) {
    const auto engine = make_parallel_engine(s, start, {threads, 256});
    while (engine->state().time < s.run.t_end) engine->step();
    EXPECT_EQ(engine->state().counters.disk_time, end.counters.disk_time);
  }
}

// More than find room: none ever overlaps, the rest waits and is counted, and the limit holds.
TEST_P(SourceSink, NeverIntoAnOverlap) {
  Scene s = scene(0.05, 10.0);
  Source source = source_of(50.0, 1.0);
  source.region_low = {10.0, 10.0};
  source.region_high = {20.0, 20.0};
  source.limit = 300;
  s.sources.push_back(source);
  const State start = test::state_of(s, {{15.0, 15.0, 0.0, 0.0, 3.0, 1.0}});
  const State end =
      test::run(s, start, [&](const Engine& engine) { EXPECT_EQ(max_overlap(engine.state().disks, s.box), 0.0); });
  EXPECT_GT(end.counters.emitted, 5U);
  EXPECT_GT(end.counters.waiting, 200U);
  EXPECT_EQ(end.counters.emitted + end.counters.waiting, 300U);
  EXPECT_EQ(end.sources[0].emitted, end.counters.emitted);
  EXPECT_EQ(disk_at(end.disks, 0).radius, 3.0);
  EXPECT_EQ(disk_at(end.disks, 1).radius, 1.0);
}

TEST_P(SourceSink, StopsAtItsLimit) {
  Scene s = scene(0.1, 10.0);
  for (double rate : {20.0, 30.0}) {
    Source source = source_of(rate, 0.05);
    source.region_low = {1.0, 1.0};
    source.region_high = {99.0, 99.0};
    source.limit = static_cast<Count>(rate);
    s.sources.push_back(source);
  }
  const State end = test::run(s, test::state_of(s, {}));
  EXPECT_EQ(end.sources[0].emitted, 20U);
  EXPECT_EQ(end.sources[1].emitted, 30U);
  EXPECT_EQ(end.counters.waiting, 0U);
  EXPECT_EQ(end.disks.size(), 50U);
}

// Likewise with exact: none waits for more than the limit.
TEST(ExactSource, StopsAtItsLimit) {
  Scene s = test::scene_of(Method::exact, 100.0, 100.0, 0.1, 3.0);
  for (const double y : {20.0, 80.0}) {
    Source source = source_of(10.0, 0.05);
    source.region_low = {1.0, y - 10.0};
    source.region_high = {99.0, y + 10.0};
    source.limit = y < 50.0 ? Count{7} : Count{25};
    s.sources.push_back(source);
  }
  const State end = test::run(s, test::state_of(s, {}));
  EXPECT_EQ(end.counters.emitted, 32U);
  EXPECT_EQ(end.counters.waiting, 0U);
}

// A sink takes a disk in the step in which its edge touches, not its centre, and no other disk.
TEST_P(SourceSink, SinkRemovesOnContact) {
  for (Side side : all_sides) {
    Scene s = scene(0.1, 3.0);
    s.box.sides[static_cast<std::size_t>(side)] = SideKind::sink;
    const bool across_x = side == Side::left || side == Side::right;
    const double out = side == Side::left || side == Side::bottom ? -1.0 : 1.0;
    // 2.05 from the side, at speed 1: touches at 2.05, within the step that ends at 2.1.
    Disk leaving{50.0, 50.0, 0.0, 0.0, 1.0, 1.0};
    (across_x ? leaving.x : leaving.y) = 50.0 + out * 46.95;
    (across_x ? leaving.vx : leaving.vy) = out;
    const State start =
        test::state_of(s, {{30.0, 30.0, 0.0, 0.0, 1.0, 1.0}, leaving, {70.0, 70.0, 0.0, 0.0, 1.0, 1.0}});
    const State end = test::run(s, start, [&](const Engine& engine) {
      EXPECT_EQ(engine.state().disks.size(), engine.state().time < 2.06 ? 3U : 2U) << engine.state().time;
    });
    EXPECT_EQ(end.counters.removed, 1U);
    EXPECT_EQ(end.disks.id, (std::vector<DiskId>{0, 2}));
  }
}

// Left to right through the box: every disk has an id of its own, larger for a later one, none used twice.
TEST_P(SourceSink, IdsAreNeverReused) {
  Scene s = test::scene_of(GetParam(), 20.0, 20.0, 0.05, 20.0);
  s.box.sides[static_cast<std::size_t>(Side::right)] = SideKind::sink;
  Source source = source_of(5.0, 0.3);
  source.side = Side::left;
  source.velocities.kind = VelocityLaw::Kind::maxwell;
  source.velocities.temperature = 16.0;
  s.sources.push_back(source);
  std::set<DiskId> gone;
  std::vector<DiskId> present;
  const State end = test::run(s, test::state_of(s, {}), [&](const Engine& engine) {
    const std::vector<DiskId>& ids = engine.state().disks.id;
    EXPECT_EQ(std::set<DiskId>(ids.begin(), ids.end()).size(), ids.size());
    for (DiskId id : ids) EXPECT_EQ(gone.count(id), 0U);
    for (DiskId id : present) {
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) gone.insert(id);
    }
    present = ids;
  });
  EXPECT_GT(end.counters.removed, 20U);
  EXPECT_EQ(end.disks.size(), end.counters.emitted - end.counters.removed);
}

// Through each side: touching it, inside the box, moving inward.
TEST(Emission, ThroughASideTouchesItAndMovesInward) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  for (Side side : all_sides) {
    Source source = source_of(1.0, 0.5);
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

// A gas behind a hole: the speed along the normal is weighted by itself, density m v / T exp(-m v^2 / 2 T), mean
// sqrt(pi T / 2 m), variance (2 - pi / 2) T / m; across it a normal deviate of variance T / m. 4 standard errors.
TEST(Emission, MaxwellIsThatOfAGasBehindAHole) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  Source source = source_of(1.0, 0.5);
  source.side = Side::left;
  source.mass = constant(4.0);
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

// Two sources draw from streams of their own.
TEST(Emission, SourcesDiffer) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  Source source = source_of(1.0, 0.5);
  source.region_low = {1.0, 1.0};
  source.region_high = {29.0, 19.0};
  s.sources = {source, source};
  EXPECT_NE(draw_emission(s, s.box, 0, 5, 0, 0).x, draw_emission(s, s.box, 1, 5, 0, 0).x);
  EXPECT_NE(draw_emission(s, s.box, 0, 5, 0, 0).x, draw_emission(s, s.box, 0, 5, 0, 1).x);
  EXPECT_EQ(draw_emission(s, s.box, 0, 5, 0, 0).x, draw_emission(s, s.box, 0, 5, 0, 0).x);
}

// Between the sides where they are, all along the one that it comes through; into the frame of one that moves.
TEST(Emission, ThroughASideStaysBetweenThoseThatHaveMoved) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  Source source = source_of(1.0, 0.5);
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
    EXPECT_GE(d.vx, 5.0) << "the side comes on at 5";
    EXPECT_LE(d.vx, 6.0);
    least = std::min(least, d.y);
    most = std::max(most, d.y);
  }
  EXPECT_GE(least, 6.5);
  EXPECT_LE(most, 16.5);
  EXPECT_NEAR(most - least, 10.0, 0.2) << "of 400 places";
}

// I w^2 has the mean T; 4 standard errors of the mean of n squares of a normal deviate.
TEST(Emission, SpinsAreThoseOfTheirTemperature) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  s.physics.surfaces.inertia = 0.3;
  Source source = source_of(1.0, 0.5);
  source.mass = constant(4.0);
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

// All that they come with: of motion, of place and of rotation.
TEST(Emission, EnergyOfNewDisksIsCounted) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 1.0);
  s.physics.gravity = Gravity(0.25, 0.5);
  s.physics.surfaces.inertia = 0.5;
  Source source = source_of(1.0, 0.1);
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

// A disk that is due at the end of a run does not come, also where k / rate is below t_end by rounding, as 33 / 1.1 is
// below 30; where the run goes on it does.
TEST(ExactSource, NoDiskComesAtTheEnd) {
  struct Case {
    double rate, t_end;
    Count disks;
  };
  for (const Case& c : {Case{1.1, 30.0, 32}, {2.2, 15.0, 32}, {4.4, 7.5, 32}, {1.0, 30.0, 29}, {1.7, 30.0, 50}}) {
    Scene s = test::scene_of(Method::exact, 100.0, 100.0, 0.0, c.t_end);
    Source source = source_of(c.rate, 0.1);
    source.region_low = {1.0, 1.0};
    source.region_high = {99.0, 99.0};
    source.velocities.kind = VelocityLaw::Kind::maxwell;
    source.velocities.temperature = 1.0;
    s.sources.push_back(source);
    Scene longer = s;
    longer.run.t_end = c.t_end + 0.5 / c.rate;  // before the next one is due
    const Count whole = test::run(longer, test::state_of(s, {})).counters.emitted;
    for (const bool reference : {true, false}) {
      const auto finish = [&](const Scene& scene, const State& from) {
        const auto engine = reference ? make_reference_engine(scene, from) : make_parallel_engine(scene, from, {1, 1});
        while (engine->state().time < scene.run.t_end) engine->step();
        return engine->state();
      };
      const State end = finish(s, test::state_of(s, {}));
      EXPECT_EQ(end.counters.emitted, c.disks) << c.rate << " to " << c.t_end;
      EXPECT_EQ(finish(longer, end).counters.emitted, whole) << c.rate << " beyond " << c.t_end;
    }
  }
}

// What waits is the sum over the sources.
TEST(Emission, DisksOfAllSourcesWait) {
  Scene s = test::scene_of(Method::pairwise, 30.0, 20.0, 0.1, 10.0);
  Source source = source_of(1.0, 0.5);
  source.region_low = {1.0, 1.0};
  source.region_high = {29.0, 19.0};
  s.sources = {source, source};
  s.sources[1].rate = 2.0;
  State state = test::state_of(s, {});
  emit_due(s, state, 3.0, 30, [](const Disk&) { return false; });
  EXPECT_EQ(state.counters.waiting, 3U + 6U);
}

// A region may reach closer to a wall than a radius: what is drawn there waits, at each of the four walls alike.
TEST(Emission, FromARegionIsWithinAllWalls) {
  Scene s = test::scene_of(Method::pairwise, 6.0, 4.0, 0.1, 6.0);
  const auto anywhere = [](const Disk&) { return true; };
  for (const auto& [low, high] :
       {std::pair{Vec2{0.0, 1.9}, Vec2{0.3, 2.1}}, std::pair{Vec2{5.7, 1.9}, Vec2{6.0, 2.1}},
        std::pair{Vec2{2.9, 0.0}, Vec2{3.1, 0.3}}, std::pair{Vec2{2.9, 3.7}, Vec2{3.1, 4.0}}}) {
    Source source = source_of(1.0, 0.25);
    source.region_low = low;
    source.region_high = high;
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

// 3.3 - 1.1 is less than 2.2 in binary numbers; such a scene was refused, as if there were no place.
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

// Where all that have waited find room at once, no more come than the limit.
TEST(Emission, OfThoseThatWaitedNoMoreComeThanTheLimit) {
  Scene s = test::scene_of(Method::exact, 30.0, 20.0, 0.1, 9.0);
  Source source = source_of(1.0, 0.5);
  source.region_low = {1.0, 1.0};
  source.region_high = {29.0, 19.0};
  source.limit = 2;
  s.sources = {source};
  State state = test::state_of(s, {});
  emit_from_source(s, s.box, state, 0, 5, 5, {}, [](const Disk&) { return true; });
  EXPECT_EQ(state.disks.size(), 2U);
  EXPECT_EQ(state.counters.waiting, 0U);
}

}  // namespace
}  // namespace carom
