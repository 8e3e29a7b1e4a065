// Fixed disks: the same bits from both engines, on any number of threads and after resume, and the physics of a disk
// that does not move.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state.hpp"
#include "core/measure/invariants.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/scene/scene.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"
#include "tests/support/feature_scenes.hpp"
#include "tests/support/resume_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

constexpr int steps = 12;

Scene scene_of(const test::Features& f) {
  Scene scene = test::feature_scene(f, steps);
  if (f.method == "exact") scene.physics.collapse_contact_time = 1e-3;
  return scene;
}

// Every seventh combination of features, with obstacles added.
std::vector<test::Features> features_with_obstacles(const std::string& method, const std::string& sides,
                                                    std::size_t offset) {
  std::vector<test::Features> some;
  const std::vector<test::Features> all = test::all_features(method, sides);
  for (std::size_t k = offset; k < all.size(); k += 7) {
    if (sides == "moving" && all[k].radii == "wide") continue;  // there is no room for large disks
    some.push_back(all[k]);
    some.back().obstacles = true;
  }
  return some;
}

class Obstacles : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {
 protected:
  std::vector<test::Features> features() const {
    const auto [method, sides] = GetParam();
    return features_with_obstacles(method, sides, std::string(sides).size() % 7);
  }
};

TEST_P(Obstacles, BitsOfTheReferenceOnAnyThreads) {
  for (const test::Features& f : features()) {
    SCOPED_TRACE(f.name());
    const Scene scene = scene_of(f);
    const State start = initial_state(scene);
    ASSERT_EQ(start.obstacles.size(), f.sides == "moving" ? 15U : f.diffusion.empty() ? 18U : 17U);
    const State end = test::expect_bits_of_reference(scene, start, steps);
    EXPECT_LT(deepest_overlap(end.disks, scene.box).size, 0.5);
  }
}

TEST_P(Obstacles, ResumedRunsHaveTheSameBits) {
  int first = 0;
  for (const test::Features& f : features()) {
    SCOPED_TRACE(f.name());
    const Scene scene = scene_of(f);
    test::expect_same_bits(scene, initial_state(scene), steps, first++);
  }
}

constexpr std::array methods{"pairwise", "rollback", "exact"};
INSTANTIATE_TEST_SUITE_P(AllMethods, Obstacles,
                         ::testing::Combine(::testing::ValuesIn(methods), ::testing::Values("moving")),
                         test::method_and_sides);
INSTANTIATE_TEST_SUITE_P(LongAllMethods, Obstacles,
                         ::testing::Combine(::testing::ValuesIn(methods),
                                            ::testing::Values("wall", "periodic", "periodic_x", "sink")),
                         test::method_and_sides);

Scene fixed_scene(const std::string& method, const std::string& physics, const std::string& disks, double t_end) {
  return parse_scene("[box]\nwidth = 20.0\nheight = 20.0\n[physics]\n" + physics + "\n" + disks + "[run]\nmethod = \"" +
                         method + "\"\ndt = 0.001\nt_end = " + std::to_string(t_end) + "\n",
                     "fixed.toml", "");
}

State run_to_end(const Scene& scene) {
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2, 1});
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

const std::string peg = "[[disks]]\nfixed = true\ncount = 1\npositions = [[10.0, 10.0]]\nradius = 1.0\n";

// The path is off the line of centres by b = 1. The normal at contact makes an angle of asin(b / 2) = 30 degrees with
// it, so the disk is deflected by 180 - 60 degrees.
TEST(FixedDisk, ScattersAsAWallThatIsCurved) {
  const std::string flying =
      "[[disks]]\ncount = 1\npositions = [[5.0, 11.0]]\nvelocities = [[2.0, 0.0]]\nradius = 1.0\nmass = 3.0\n";
  for (const char* method : {"exact", "pairwise", "rollback"}) {
    const State state = run_to_end(fixed_scene(method, "", peg + flying, 3.0));
    EXPECT_EQ(state.counters.wall_collisions, 1U) << method;
    EXPECT_EQ(state.counters.collisions, 0U) << method;
    ASSERT_EQ(state.disks.size(), 1U);
    EXPECT_EQ(state.disks.id[0], 1U);
    EXPECT_NEAR(state.disks.vx[0], -1.0, 1e-12) << method;
    EXPECT_NEAR(state.disks.vy[0], std::sqrt(3.0), 1e-12) << method;
  }
}

// A disk that falls from rest onto the top of a fixed disk returns to its height, again and again.
TEST(FixedDisk, BouncesBackToItsHeight) {
  const std::string falling = "[[disks]]\ncount = 1\npositions = [[10.0, 14.0]]\nradius = 1.0\nmass = 3.0\n";
  // The disk falls 2 in a time of 2 with g = 1; after eight falls and rises, at t = 32, it is there again.
  const State state = run_to_end(fixed_scene("exact", "gravity = 1.0", peg + falling, 32.0));
  EXPECT_EQ(state.counters.wall_collisions, 8U);
  EXPECT_NEAR(state.disks.y[0], 14.0, 1e-12);
  EXPECT_NEAR(state.disks.vy[0], 0.0, 1e-12);
}

// Under gravity the energy is conserved, whichever way the disk reaches the obstacle, also from below.
TEST(FixedDisk, KeepsEnergyUnderGravity) {
  const std::string gas =
      "[[disks]]\ncount = 40\npositions = \"random\"\nvelocities = { uniform = 3.0 }\nradius = 0.4\nmass = 2.0\n";
  const std::string pegs =
      "[[disks]]\nfixed = true\ncount = 60\npositions = \"random\"\nradius = { uniform = [0.1, 0.7] }\n";
  const Scene scene = fixed_scene("exact", "gravity = 2.0", gas + pegs, 20.0);
  const State start = initial_state(scene);
  const State end = run_to_end(scene);
  EXPECT_GT(end.counters.wall_collisions, 1000U);
  const double before = energy_of(start.disks, 2.0).total();
  EXPECT_NEAR(energy_of(end.disks, 2.0).total(), before, 1e-11 * before);
  Domain box = scene.box;
  const auto cells = place_obstacles(end.obstacles, box);
  EXPECT_LT(wall_overlap(end.disks, box), 1e-12);
}

// A disk in the groove between two fixed ones, and three more on top of it: they come to rest and stay there.
TEST(FixedDisk, BearsAPile) {
  const std::string disks =
      "[[disks]]\nfixed = true\ncount = 12\npositions = [[1.0, 2.0], [2.8, 1.7], [4.6, 2.0], [6.4, 1.7], [8.2, 2.0], "
      "[10.0, "
      "1.7], [11.8, 2.0], [13.6, 1.7], [15.4, 2.0], [17.2, 1.7], [19.0, 2.0], [20.0, 1.7]]\nradius = 0.8\n"
      "[[disks]]\ncount = 60\npositions = \"random\"\nradius = { uniform = [0.4, 0.6] }\nmass = 1.0\n";
  Scene scene = fixed_scene("pairwise", "gravity = 1.0\nrestitution = 0.4", disks, 80.0);
  scene.run.dt = 0.01;
  const State end = run_to_end(scene);
  const double kinetic = energy_of(end.disks, 1.0).kinetic;
  EXPECT_LT(kinetic, 1e-9 * energy_of(initial_state(scene).disks, 1.0).total());
  Domain box = scene.box;
  const auto cells = place_obstacles(end.obstacles, box);
  EXPECT_LT(wall_overlap(end.disks, box), 0.01);
  EXPECT_LT(max_overlap(end.disks, box), 0.01);
  for (std::size_t i = 0; i < end.disks.size(); ++i) EXPECT_GT(end.disks.y[i], 1.9) << "disk " << end.disks.id[i];
}

// With a few large cells the search at a periodic side might find an obstacle twice, inside the box and beyond the
// side.
TEST(FixedDisk, IsTouchedOnceAtPeriodicSides) {
  Domain box;
  box.width = 15.0;
  box.height = 27.0;
  box.sides = {SideKind::periodic, SideKind::periodic, SideKind::periodic, SideKind::periodic};
  const std::vector<Obstacle> obstacles{{1.3, 18.6, 0.0, 0.0, 0.2, 1.0, 0, ObstacleKind::disk},
                                        {14.8, 26.9, 0.0, 0.0, 0.3, 1.0, 1, ObstacleKind::disk},
                                        {0.2, 3.0, 12.0, 1.0, 0.0, 1.0, 0, ObstacleKind::wall},
                                        {14.5, 1.0, -4.0, 25.8, 0.0, 1.0, 1, ObstacleKind::sink}};
  const auto cells = place_obstacles(obstacles, box);
  int touched = 0;
  for (double x = 0.05; x < box.width; x += 0.1) {
    for (double y = 0.05; y < box.height; y += 0.1) {
      std::vector<int> found(obstacles.size(), 0);
      for_each_obstacle_touched(box, x, y, 0.9, [&](std::uint32_t k, const ObstacleGap&) { ++found[k]; });
      for (std::size_t k = 0; k < obstacles.size(); ++k) {
        ASSERT_EQ(found[k], gap_to(obstacles[k], x, y, 0.9, box).beyond >= 0.0 ? 1 : 0) << k << ": " << x << ", " << y;
        touched += found[k];
      }
    }
  }
  EXPECT_GT(touched, 0);
}

// Sources emit disks only where obstacles leave room.
TEST(FixedDisk, SourcesKeepClearOfIt) {
  const std::string source = "[[sources]]\nregion = [8.0, 8.0, 12.0, 12.0]\nrate = 50.0\nradius = 0.1\nmass = 1.0\n";
  for (const char* method : {"exact", "pairwise", "rollback"}) {
    const Scene scene = fixed_scene(method, "", peg + source, 0.5);
    const State end = run_to_end(scene);
    EXPECT_GT(end.disks.size(), 10U);
    for (std::size_t i = 0; i < end.disks.size(); ++i) {
      EXPECT_GT(std::hypot(end.disks.x[i] - 10.0, end.disks.y[i] - 10.0), 1.1) << method;
    }
  }
}

std::string with_fixed(std::string_view line) {
  return test::complaint(test::replaced(test::sound_scene, "mass = 2.0", line));
}

TEST(BadFixedDisk, OneLineEach) {
  using testing::StartsWith;
  EXPECT_THAT(
      with_fixed("mass = inf"),
      StartsWith(
          "gas.toml:18: disks.0.mass: is inf; expected a number above 0; for disks that never move use fixed = true"));
  EXPECT_EQ(with_fixed("fixed = true"),
            "gas.toml:16: disks.0.velocities: cannot be used with fixed = true; expected fixed disks without this key");
  EXPECT_EQ(with_fixed("mass = 2.0\nfixed = true"),
            "gas.toml:18: disks.0.mass: cannot be used with fixed = true, which is an infinite mass; expected fixed "
            "disks without this key");
  EXPECT_THAT(with_fixed("mass = 2.0\nfixed = 1"),
              StartsWith("gas.toml:19: disks.0.fixed: is an integer; expected true or false"));
  EXPECT_THAT(with_fixed("mass = 2.0\nfixd = true"), testing::HasSubstr("(nearest: fixed)"));
}

const std::string two_pegs =
    "[[disks]]\nfixed = true\ncount = 2\npositions = [[0.5, 5.0], [1.0, 5.0]]\nradius = 1.0\n\n[run]";

// Fixed disks may overlap each other and reach out of the box; other disks may not overlap them.
TEST(BadFixedDisk, OverlapIsReportedAndAmongThemselvesIsNot) {
  const std::string with_two = test::replaced(test::sound_scene, "[run]", two_pegs);
  EXPECT_EQ(test::complaint(with_two), "");
  EXPECT_THAT(test::complaint(test::replaced(with_two, "[2, 2]", "[2, 4]")), testing::HasSubstr("overlap by"));
}

// Other disks may grow around fixed ones (growth_test), but fixed disks do not grow.
TEST(BadFixedDisk, DoesNotGrow) {
  const std::string text = test::replaced(test::sound_scene, "[run]", two_pegs);
  const std::string growing = test::replaced(text, "positions = [[2, 2], [5, 5], [8, 2]]", "positions = \"growth\"");
  EXPECT_EQ(test::complaint(growing), "");
  EXPECT_THAT(
      test::complaint(test::replaced(growing, "positions = [[0.5, 5.0], [1.0, 5.0]]", "positions = \"growth\"")),
      testing::HasSubstr("disks.1.positions: is \"growth\" for fixed disks"));
}

}  // namespace
}  // namespace carom
