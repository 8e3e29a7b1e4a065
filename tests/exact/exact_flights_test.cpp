// Flights between which radii grow: an engine that keeps its neighbour lists has the same bits as a new engine, and its
// lists contain, for each disk, all disks against which it may grow.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/start/growth_step.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/exact/exact_engine.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

struct Case {
  const char* name;
  const char* sides;
  const char* disks;
  int threads = 1;
  std::size_t divisor = 1;
};

constexpr const char* periodic =
    "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";
constexpr const char* equal = "count = 900\nradius = 0.3";
constexpr const char* mixed = "count = 700\nradius = { uniform = [0.15, 0.5] }";
constexpr const char* few = "count = 30\nradius = { uniform = [0.5, 1.5] }";

// Small boxes, so the parts have narrow halos.
const std::vector<Case>& cases() {
  static const std::vector<Case> all{{"equal", periodic, equal},
                                     {"mixed", "", mixed},
                                     {"few", periodic, few},
                                     {"equal, in parts", periodic, equal, 3, 200},
                                     {"mixed, in parts", "", mixed, 2, 200}};
  return all;
}

Scene scene_of(const Case& c) {
  return test::scene_from(fmt::format(
      "[box]\nwidth = 60\nheight = 12\n{}[[disks]]\n{}\npositions = \"random\"\nvelocities = {{ maxwell = 1.0 }}\n"
      "mass = 1\n[run]\nmethod = \"exact\"\nt_end = 0.05\n",
      c.sides, c.disks));
}

std::vector<double> targets(const State& state, double share) {
  std::vector<double> target(state.next_id);
  for (std::size_t i = 0; i < state.disks.size(); ++i) target[state.disks.id[i]] = share * state.disks.radius_of(i);
  return target;
}

// Each disk has a radius of its own, as growth needs.
State start_of(const Scene& scene) {
  State state = initial_state(scene);
  Disks& d = state.disks;
  if (d.radius.empty()) d.radius.assign(d.size(), d.common_radius);
  return state;
}

double most_growth(const GrowthTally& tally) {
  return tally.most_lack / closed_share;
}

void expect_all_near(const ExactFlights& flights, const Disks& d, const Domain& box,
                     const std::vector<double>& target) {
  std::vector<std::set<std::size_t>> listed(d.size());
  flights.visit_lists([&](std::size_t i, std::span<const std::uint32_t> near) {
    listed[i] = {near.begin(), near.end()};
  });
  for (std::size_t i = 0; i < d.size(); ++i) {
    const double reach = growth_reach(d.radius[i], target[d.id[i]]);
    for (std::size_t j = 0; j < d.size(); ++j) {
      const double distance2 = nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box);
      if (j == i || !touches(distance2, reach + growth_reach(d.radius[j], target[d.id[j]]))) continue;
      ASSERT_TRUE(listed[i].contains(j)) << d.id[i] << " and " << d.id[j];
    }
  }
}

// The target of all radii is `share` times their start. Returns the number of flights whose lists were complete.
int fly(const Case& c, int count, double share) {
  Scene scene = scene_of(c);
  State state = start_of(scene);
  const std::vector<double> target = targets(state, share);
  GrowthTally tally = grow_step(state.disks, scene.box, target);
  const std::unique_ptr<ExactFlights> flights =
      make_exact_flights(scene, state, {c.threads, c.divisor}, most_growth(tally));
  double asked = most_growth(tally);
  int told = 0;
  for (int k = 0; k < count; ++k) {
    if (k > 0) {
      asked = most_growth(tally);
      flights->begin_flight(state, scene.run.t_end, asked, flights->growth() > 0.0);
    }
    const auto fresh = make_parallel_exact(scene, state, {1});
    while (fresh->state().time < scene.run.t_end) fresh->step();
    while (flights->state().time < scene.run.t_end) flights->step();
    state = flights->end_flight();
    EXPECT_EQ(state_hash(state.disks), state_hash(fresh->state().disks)) << "flight " << k;
    EXPECT_EQ(state.counters.collisions, fresh->state().counters.collisions) << "flight " << k;
    if (flights->growth() > 0.0) {
      ++told;
      EXPECT_GE(flights->growth(), asked);
      expect_all_near(*flights, state.disks, scene.box, target);
    }
    tally = grow_step(state.disks, scene.box, target);
    state.time = 0.0;
    state.counters = {};
    scene.run.t_end *= k % 5 == 4 ? 3.0 : 0.9;
  }
  EXPECT_LT(tally.lacking, state.disks.size() / 2);
  return told;
}

TEST(ExactFlights, KeepTheirListsAndFlyAsFreshOnes) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    EXPECT_GE(fly(c, 15, 1.35), 13);
  }
}

// A giant among so many disks that regions are used. In regions disks at borders are relisted late, so lists are not
// complete.
TEST(ExactFlights, DoNotTellOfRegions) {
  Case c{"regions", periodic,
         "count = 1\nradius = 3\npositions = \"random\"\nmass = 1\n[[disks]]\ncount = 8400\nradius = 0.1", 2, 200};
  EXPECT_EQ(fly(c, 3, 1.01), 0);
}

}  // namespace
}  // namespace carom
