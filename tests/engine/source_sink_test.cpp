// Disks that come and go: rates, room, limits, sinks, ids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/measure/invariants.hpp"
#include "core/step/source.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/source_by_hand.hpp"

namespace carom {
namespace {

class SourceSink : public testing::TestWithParam<Method> {
 protected:
  Scene scene(double dt, double t_end) const { return test::scene_of(GetParam(), 100.0, 100.0, dt, t_end); }
};

INSTANTIATE_TEST_SUITE_P(Methods, SourceSink, testing::ValuesIn(test::stepping_methods),
                         [](const auto& method) { return test::name_of(method.param); });

// The k-th disk is due at k / rate, even if rate * (k / rate) is rounded to less than k.
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

// The k-th disk is due at k / rate. If there is room for all, floor(rate t) disks have come after every step, where t
// is the step's start.
TEST_P(SourceSink, EmitsAtItsRate) {
  Scene s = scene(0.1, 20.0);
  Source source = test::source_in({1.0, 1.0}, {99.0, 99.0}, 7.0, 0.1);
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

// The time of a disk that leaves through a sink counts until it leaves, to half a step; rates are relative to the sum
// of these times.
TEST_P(SourceSink, CountsHowLongDisksAreThere) {
  constexpr double dt = 0.25;
  Scene s = scene(dt, 64.0);
  s.box.sides[static_cast<std::size_t>(Side::left)] = SideKind::sink;
  const State start = test::state_of(s, {{11.0, 20.0, -1.0, 0.0, 1.0, 1.0},   // leaves at t = 10
                                         {41.0, 40.0, -2.0, 0.0, 1.0, 1.0},   // leaves at t = 20
                                         {50.0, 80.0, 0.0, 0.0, 1.0, 1.0}});  // stays
  const State end = test::run(s, start);
  EXPECT_EQ(end.counters.removed, 2U);
  EXPECT_EQ(end.taken[sink_number(Side::left)], 2U);
  EXPECT_NEAR(end.counters.disk_time, 10.0 + 20.0 + 64.0, 2.0 * dt);
}

// In exact the time counts until the contact with the sink, for any windows and any number of threads.
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

// More disks are due than there is room for: none ever overlaps another, the rest waits and is counted, and the limit
// holds.
TEST_P(SourceSink, NeverIntoAnOverlap) {
  Scene s = scene(0.05, 10.0);
  Source source = test::source_in({10.0, 10.0}, {20.0, 20.0}, 50.0, 1.0);
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
    Source source = test::source_in({1.0, 1.0}, {99.0, 99.0}, rate, 0.05);
    source.limit = static_cast<Count>(rate);
    s.sources.push_back(source);
  }
  const State end = test::run(s, test::state_of(s, {}));
  EXPECT_EQ(end.sources[0].emitted, 20U);
  EXPECT_EQ(end.sources[1].emitted, 30U);
  EXPECT_EQ(end.counters.waiting, 0U);
  EXPECT_EQ(end.disks.size(), 50U);
}

// The same in exact: no more disks wait than the limit allows.
TEST(ExactSource, StopsAtItsLimit) {
  Scene s = test::scene_of(Method::exact, 100.0, 100.0, 0.1, 3.0);
  for (const double y : {20.0, 80.0}) {
    Source source = test::source_in({1.0, y - 10.0}, {99.0, y + 10.0}, 10.0, 0.05);
    source.limit = y < 50.0 ? Count{7} : Count{25};
    s.sources.push_back(source);
  }
  const State end = test::run(s, test::state_of(s, {}));
  EXPECT_EQ(end.counters.emitted, 32U);
  EXPECT_EQ(end.counters.waiting, 0U);
}

// A sink takes a disk in the step in which the disk's edge touches it, not its centre, and takes no other disk.
TEST_P(SourceSink, SinkRemovesOnContact) {
  for (Side side : all_sides) {
    Scene s = scene(0.1, 3.0);
    s.box.sides[static_cast<std::size_t>(side)] = SideKind::sink;
    const bool across_x = side == Side::left || side == Side::right;
    const double out = side == Side::left || side == Side::bottom ? -1.0 : 1.0;
    // The disk is 2.05 from the side, at speed 1: it touches at t = 2.05, within the step that ends at 2.1.
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

// Disks move through the box from left to right: each has an id of its own, later ones a larger one, and none is used
// twice.
TEST_P(SourceSink, IdsAreNeverReused) {
  Scene s = test::scene_of(GetParam(), 20.0, 20.0, 0.05, 20.0);
  s.box.sides[static_cast<std::size_t>(Side::right)] = SideKind::sink;
  Source source = test::source_of(5.0, 0.3);
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

// A disk that is due at the end of a run does not come, even if k / rate is below t_end by rounding, as 33 / 1.1 is
// below 30; it comes if the run goes on.
TEST(ExactSource, NoDiskComesAtTheEnd) {
  struct Case {
    double rate, t_end;
    Count disks;
  };
  for (const Case& c : {Case{1.1, 30.0, 32}, {2.2, 15.0, 32}, {4.4, 7.5, 32}, {1.0, 30.0, 29}, {1.7, 30.0, 50}}) {
    Scene s = test::scene_of(Method::exact, 100.0, 100.0, 0.0, c.t_end);
    Source source = test::source_in({1.0, 1.0}, {99.0, 99.0}, c.rate, 0.1);
    source.velocities.kind = VelocityLaw::Kind::maxwell;
    source.velocities.temperature = 1.0;
    s.sources.push_back(source);
    Scene longer = s;
    longer.run.t_end = c.t_end + 0.5 / c.rate;  // before the next disk is due
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

}  // namespace
}  // namespace carom
