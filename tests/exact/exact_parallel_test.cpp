// The parallel exact engine has the bits of the reference at any number of threads, in scenes with every feature.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "parallel/exact/engine_mode.hpp"
#include "parallel/exact/exact_engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"
#include "tests/support/thread_counts.hpp"

namespace carom::exact_tests {
namespace {

struct ParallelCase {
  const char* name;
  SceneText scene;
};

void PrintTo(const ParallelCase& c, std::ostream* out) {
  *out << c.name;
}

// Parts, or otherwise regions and tiles, are made so small that even these scenes have some; with a divisor of 1 there
// are none, and one queue has all events.
State run_parallel(const Scene& scene, const State& initial, int threads, std::size_t block_divisor = 128) {
  const auto engine = make_parallel_engine(scene, initial, {threads, block_divisor});
  run_to_end(*engine, scene);
  return engine->state();
}

// Runs in regions, whose borders are processed after them, as is done if parts with halos do not pay.
State run_in_regions(const Scene& scene, const State& initial, std::size_t block_divisor = 128) {
  const auto engine = make_parallel_exact(scene, initial, {3, block_divisor}, [](const SliceBorders&) {});
  run_to_end(*engine, scene);
  return engine->state();
}

void expect_same_bits(const Scene& scene) {
  const State initial = initial_state(scene);
  const State reference = run_reference(scene, initial);
  EXPECT_GT(reference.counters.steps, 0U);
  for (const int threads : test::thread_counts) {
    ASSERT_EQ(fingerprint(run_parallel(scene, initial, threads)), fingerprint(reference)) << threads << " threads";
  }
  ASSERT_EQ(fingerprint(run_parallel(scene, initial, 2, 1)), fingerprint(reference)) << "single queue";
  ASSERT_EQ(fingerprint(run_in_regions(scene, initial)), fingerprint(reference)) << "regions";
  ASSERT_EQ(fingerprint(run_parallel(scene, initial, 3, 1024)), fingerprint(reference)) << "parts of a few disks";
  ASSERT_EQ(fingerprint(run_in_regions(scene, initial, 1024)), fingerprint(reference)) << "tiles of eight disks";
}

class ExactParallel : public testing::TestWithParam<ParallelCase> {};

TEST_P(ExactParallel, SameBitsAsReference) {
  expect_same_bits(make_scene(GetParam().scene));
}

const std::string dust = "velocities = { uniform = 1.0 }\nradius = 0.05\nmass = 0.01";
const std::string giants = "[[disks]]\ncount = 2\npositions = [[6, 6], [18, 14]]\nradius = [5, 4]\nmass = [90, 70]\n";
const std::string lattice =
    "[[disks]]\ncount = 400\npositions = \"square\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0\n";
const std::string sources =
    "[[sources]]\nside = \"left\"\nrate = 20.0\nradius = 0.3\nmass = 1.0\nvelocities = { maxwell = 1.0 }\n"
    "[[sources]]\nregion = [2, 2, 10, 10]\nrate = 7.0\nradius = { uniform = [0.2, 0.4] }\nmass = 2.0\nlimit = 9\n";
const std::string open_sides = "left = \"wall\"\nright = \"sink\"\nbottom = \"periodic\"\ntop = \"periodic\"";
const std::string hot = "left = { temperature = 25.0 }\nright = { temperature = 0.3 }\nwall_restitution = 0.9";
const std::string piston = "right = { motion = { velocity = [-1.0, 0.0] } }\nbottom = \"periodic\"\ntop = \"periodic\"";
const std::string shaken =
    "left = \"periodic\"\nright = \"periodic\"\nbottom = { restitution = 0.8, motion = { vibrate = [0, 0.4], period = "
    "1.1 } }";
const std::string shaken_fast =
    "left = { motion = { vibrate = [0.05, 0], period = 0.013 } }\nright = { motion = { vibrate = [0.3, 0], period = "
    "0.4 } }\n"
    "top = { place = 18, motion = { velocity = [0, 0.5] } }";
const std::string swinging =
    "left = { motion = { vibrate = [0.05, 0], period = 0.013, shape = \"sine\" } }\n"
    "bottom = { restitution = 0.8, motion = { vibrate = [0, 0.4], period = 1.1, shape = \"sine\" } }";
const std::string sheared =
    "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = 0.1";
const std::string sheared_fast =
    "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = -1.0";
const std::string soft = "wall_restitution = 0.7";
const std::string settling = "gravity = 1.0\nrestitution = 0.6\ncollapse = { model = \"tc\", contact_time = 0.01 }";

// Large disks at rest are carried by the flow into each other, beside crowded small disks: the lists are as short as
// the small disks require, the windows as long as the large ones allow.
const std::string resting_in_flow = random_disks(40, "radius = 1.0\nmass = 1.0") +
                                    random_disks(60, "radius = 0.001\nmass = 1.0\nregion = [8.0, 4.0, 8.03, 4.03]");

// In a flat box the skin is half of the box's height, so a disk that goes around the box leaves its skin on the way.
const std::string beside_wall =
    random_disks(45,
                 "velocities = { uniform = 1.0 }\nradius = { choice = [0.03, 1.0], weights = [5, 1] }\nmass = 1.0") +
    "[[walls]]\nfrom = [84.0, 0.0]\nto = [30.0, 0.5]\n";

const auto name_of = [](const auto& p) { return std::string(p.param.name); };

INSTANTIATE_TEST_SUITE_P(
    Scenes, ExactParallel,
    testing::Values(
        ParallelCase{"two", {10, 10, "periodic", "", random_disks(2, equal_disks), 200, ""}},
        ParallelCase{"one",
                     {10, 10, "wall", "gravity = 0.3",
                      random_disks(1, "velocities = [[1.0, 0.3]]\nradius = 1\nmass = 1"), 50, ""}},
        ParallelCase{"few", {9, 9, "periodic", "", random_disks(30, equal_disks), 20, ""}},
        ParallelCase{"fluid", {25, 25, "periodic", "", random_disks(350, equal_disks), 6, ""}},
        ParallelCase{"sheared_few", {9, 11, sheared, "", random_disks(30, equal_disks), 20, ""}},
        ParallelCase{"sheared_mixed", {40, 24, sheared, "restitution = 0.8", random_disks(250, mixed_disks), 12, ""}},
        ParallelCase{"sheared_at_rest", {70, 9, sheared_fast, "", resting_in_flow, 3, ""}},
        ParallelCase{"walls", {25, 25, "wall", "", random_disks(300, equal_disks), 6, ""}},
        ParallelCase{"dilute", {80, 80, "periodic", "", random_disks(150, equal_disks), 60, ""}},
        ParallelCase{
            "narrow",
            {2.3, 300, "left = \"periodic\"\nright = \"periodic\"", "", random_disks(150, equal_disks), 10, ""}},
        ParallelCase{"flat_with_wall", {84, 8.4, "periodic", "", beside_wall, 40, ""}},
        ParallelCase{"gravity", {20, 30, "wall", "gravity = 1.5", random_disks(250, equal_disks), 6, ""}},
        ParallelCase{"falling_for_ever", {20, 20, "periodic", "gravity = 2.0", random_disks(200, equal_disks), 4, ""}},
        ParallelCase{"tilted", {20, 30, "wall", "gravity = [-0.9, -1.2]", random_disks(250, equal_disks), 6, ""}},
        ParallelCase{"falling_sideways",
                     {20, 20, "periodic", "gravity = [2.0, 0.0]", random_disks(200, equal_disks), 4, ""}},
        ParallelCase{"falling_askew",
                     {20, 20, "periodic", "gravity = [-1.0, 1.5]", random_disks(200, equal_disks), 4, ""}},
        ParallelCase{"mixed", {30, 30, "wall", "", random_disks(250, mixed_disks), 12, ""}},
        ParallelCase{"mixed_inelastic",
                     {30, 30, "periodic", "restitution = 0.8", random_disks(250, mixed_disks), 12, ""}},
        ParallelCase{"giants_in_dust", {24, 24, "periodic", "", giants + random_disks(400, dust), 10, ""}},
        ParallelCase{"tc", {20, 40, soft, settling, random_disks(120, mixed_disks), 12, ""}},
        ParallelCase{"hot", {25, 25, hot, "restitution = 0.95", random_disks(300, equal_disks), 6, ""}},
        ParallelCase{"hot_with_source", {20, 20, hot, "", sources, 10, ""}},
        ParallelCase{"piston", {25, 25, piston, "", random_disks(250, equal_disks), 6, ""}},
        ParallelCase{"piston_of_resting_disks",
                     {25, 25, piston, "", random_disks(150, "radius = 0.5\nmass = 1.0"), 12, ""}},
        ParallelCase{"shaken",
                     {20, 30, shaken, "gravity = 1.0\nrestitution = 0.9", random_disks(150, mixed_disks), 6, ""}},
        ParallelCase{"shaken_tc", {20, 30, shaken, settling, random_disks(120, mixed_disks), 6, ""}},
        ParallelCase{"swinging", {20, 20, swinging, "", random_disks(150, equal_disks), 2, ""}},
        ParallelCase{"brownian",
                     {20, 20, "periodic", "diffusion = 0.5", random_disks(200, equal_disks), 1, "dt = 0.01"}},
        ParallelCase{"sinks", {20, 20, "sink", "", random_disks(200, equal_disks), 10, ""}},
        ParallelCase{"sources", {20, 20, open_sides, "", random_disks(100, equal_disks) + sources, 10, ""}},
        ParallelCase{"sources_alone", {20, 20, open_sides, "gravity = 0.2", sources, 10, ""}}),
    name_of);

// More scenes of the same kinds, each of which takes a third of a second.
INSTANTIATE_TEST_SUITE_P(
    LongScenes, ExactParallel,
    testing::Values(
        ParallelCase{"sheared", {25, 25, sheared, "", random_disks(350, equal_disks), 8, ""}},
        ParallelCase{"sheared_fast",
                     {25, 30, sheared_fast, "restitution = 0.9", random_disks(350, equal_disks), 6, ""}},
        ParallelCase{"sheared_dilute", {80, 80, sheared, "", random_disks(150, equal_disks), 60, ""}},
        ParallelCase{"crystal", {21, 21, "periodic", "", lattice, 3, ""}},
        ParallelCase{"tilted_mixed", {24, 24, "wall", "gravity = [0.9, 0.2]", random_disks(200, mixed_disks), 8, ""}},
        ParallelCase{"tc_tilted",
                     {20, 40, soft,
                      "gravity = [0.6, -0.8]\nrestitution = 0.6\ncollapse = { model = \"tc\", contact_time = 0.01 }",
                      random_disks(120, mixed_disks), 12, ""}},
        ParallelCase{"hot_mixed", {30, 30, hot, "gravity = 0.4", random_disks(250, mixed_disks), 12, ""}},
        ParallelCase{"shaken_fast", {20, 20, shaken_fast, "", random_disks(150, equal_disks), 2, ""}},
        ParallelCase{"brownian_sinks",
                     {20, 20, "sink", "diffusion = 0.5", random_disks(200, equal_disks), 3, "dt = 0.01"}},
        ParallelCase{
            "brownian_accumulating",
            {20, 20, "wall", "diffusion = 0.5\naccumulate = true", random_disks(200, equal_disks), 1, "dt = 0.02"}}),
    name_of);

// Random scenes with all features.
TEST(ExactParallelRandom, ScenesOfAllFeatures) {
  for (std::uint32_t k = 0; k < 12; ++k) {
    const auto u = uniforms(41, Stream::position, k, 0);
    const auto w = uniforms(41, Stream::position, k, 1);
    const auto z = uniforms(41, Stream::position, k, 2);
    SceneText s;
    s.width = 8.0 + 20.0 * u.a;
    s.height = 8.0 + 20.0 * u.b;
    const int n = 1 + static_cast<int>(0.4 * s.width * s.height * w.a);
    s.sides = std::string(k % 2 == 0 ? "left = \"periodic\"\nright = \"periodic\"" : "left = \"sink\"") +
              "\nwall_restitution = 0.9";
    s.physics = fmt::format("gravity = {}\nrestitution = {}\ncollapse = {{ model = \"tc\", contact_time = 1e-3 }}",
                            k % 3 == 0 ? 0.0 : w.b, 0.6 + 0.4 * z.a);
    s.disks = random_disks(n, mixed_disks);
    if (k % 4 == 1)
      s.disks +=
          "[[sources]]\nside = \"right\"\nrate = 9.0\nradius = 0.2\nmass = 1.0\nvelocities = { uniform = 1.0 }\n";
    s.t_end = 3.0;
    SCOPED_TRACE(k);
    expect_same_bits(make_scene(s));
  }
}

// Disks that lie on each other without rebound: rounding decides whether two of them touch and approach, and does so
// anew at the start of the paths in each window.
TEST(ExactParallelContacts, ThatLast) {
  std::string column = "[[disks]]\ncount = 11\nradius = 1\nmass = 1\npositions = [";
  std::string velocities = "velocities = [";
  for (int k = 0; k < 11; ++k) {
    column += fmt::format("{}[2, {}]", k == 0 ? "" : ", ", 2 + 2 * k);
    velocities += fmt::format("{}{}", k == 0 ? "" : ", ", k == 3 ? "[-0.7434, 0.6309]" : "[0, 0]");
  }
  const std::string physics =
      "gravity = 0.2548\nrestitution = 0\ncollapse = { model = \"tc\", contact_time = 0.02313 }";
  expect_same_bits(make_scene(
      {4, 24, "left = \"sink\"\nwall_restitution = 0.99", physics, column + "]\n" + velocities + "]\n", 30, ""}));
}

// Seven disks fill a periodic row: windows are so short that only the rounding of positions changes anything.
TEST(LongExactParallelContacts, OfDisksWithoutRoom) {
  const std::string chain =
      "[[disks]]\ncount = 7\nradius = [0.09, 0.075, 0.3, 0.15, 0.3, 0.0375, 0.0375]\nmass = 1\n"
      "positions = [[0.09, 0.6], [0.255, 0.6], [0.63, 0.6], [1.08, 0.6], [1.53, 0.6], [1.8675, 0.6], [1.9425, 0.6]]\n"
      "velocities = [[-0.5677, 0.5323], [-0.8774, -0.9481], [0.2839, -0.6561], [0.02699, -0.5021], "
      "[-0.4054, -0.02009], [-0.1341, 0.02006], [-0.3667, 0.5227]]\n";
  const Scene scene = make_scene({1.98, 1.2, "periodic", "", chain, 10, ""});
  const State initial = initial_state(scene);
  const auto reference = make_reference_exact(scene, initial);
  const auto parallel = make_parallel_engine(scene, initial, {2, 128});
  for (int k = 0; k < 80; ++k) {
    reference->step();
    parallel->step();
    ASSERT_EQ(fingerprint(parallel->state()), fingerprint(reference->state())) << "window " << k;
  }
}

Scene collapsing_gas(int count) {
  return parse_scene(fmt::format(R"(seed = 712775
[box]
packing_fraction = 0.3403
aspect = 0.1441
bottom = "periodic"
top = "periodic"
[physics]
restitution = 0.2
[[disks]]
count = {}
positions = "growth"
velocities = {{ uniform = 1.005 }}
radius = {{ from_mass = 0.6127 }}
mass = {{ uniform = [0.04807, 1.923] }}
[run]
method = "exact"
t_end = 60
)",
                                 count),
                     "test", ".");
}

std::string collapse_report(Engine& engine, const Scene& scene) {
  try {
    run_to_end(engine, scene);
  } catch (const PhysicsError& error) {
    return error.what();
  }
  return "none";
}

// If events pile up at one moment, the report is that of the reference in every mode.
TEST(ExactParallelCollapse, IsReportedAlike) {
  struct Case {
    int disks;
    std::size_t block_divisor;
    EngineMode mode;
  };
  for (const Case c :
       {Case{26, 1, EngineMode::all_pairs}, Case{160, 1, EngineMode::single_queue}, Case{160, 128, EngineMode::regions},
        Case{160, 512, EngineMode::regions}, Case{160, 1024, EngineMode::regions}}) {
    SCOPED_TRACE(fmt::format("{} disks, divisor {}", c.disks, c.block_divisor));
    const Scene scene = collapsing_gas(c.disks);
    const Executor executor(3, c.block_divisor);
    ASSERT_EQ(choose_layout(static_cast<std::size_t>(c.disks), scene.box, true, executor).mode, c.mode);
    const State initial = initial_state(scene);
    const std::string expected = collapse_report(*make_reference_exact(scene, initial), scene);
    EXPECT_NE(expected.find("inelastic collapse"), std::string::npos) << expected;
    const auto engine = make_parallel_engine(scene, initial, {3, c.block_divisor});
    EXPECT_EQ(collapse_report(*engine, scene), expected);
    EXPECT_EQ(collapse_report(*engine, scene), expected) << "when the engine continues from the window's start";
  }
}

// The bound on speeds fails, since a projectile scatters a cold gas and heavy disks hit light ones. Then the window is
// run again.
TEST(LongExactParallelSpeeds, ThatRiseWithinAWindow) {
  const std::string cold = "velocities = { maxwell = 1e-6 }\nradius = 0.4\nmass = 0.001";
  const std::string heavy =
      "[[disks]]\ncount = 2\npositions = [[5, 12], [19, 12.3]]\nradius = [2, 2]\nmass = [900, 700]\n"
      "velocities = [[1.0, 0.1], [-1.0, 0.0]]\n";
  expect_same_bits(make_scene({24, 24, "periodic", "", heavy + random_disks(300, cold), 6, ""}));
  expect_same_bits(make_scene({24, 24, "wall", "gravity = 3.0", heavy + random_disks(300, cold), 3, ""}));
}

// The mass of each disk in a row is a quarter of the one before, so every collision passes on 1.6 times the speed;
// together 1.6^15 = 1150 within one window.
TEST(ExactParallelSpeeds, ThatRiseAThousandfoldWithinAWindow) {
  std::string row = "[[disks]]\ncount = 16\nradius = 0.4\npositions = [";
  std::string masses = "mass = [";
  std::string velocities = "velocities = [";
  for (int k = 0; k < 16; ++k) {
    row += fmt::format("{}[{}, 12]", k == 0 ? "" : ", ", 2.0 + k * (0.8 + 1e-5));
    masses += fmt::format("{}{}", k == 0 ? "" : ", ", std::pow(0.25, k));
    velocities += fmt::format("{}[{}, 0.0]", k == 0 ? "" : ", ", k == 0 ? "1.0" : "0.0");
  }
  row += "]\n" + masses + "]\n" + velocities + "]\n";
  const std::string cold = "velocities = { maxwell = 1e-6 }\nradius = 0.4\nmass = 1.0";
  const Scene scene = make_scene({24, 24, "periodic", "", row + random_disks(300, cold), 0.05, ""});
  expect_same_bits(scene);
  double fastest2 = 0.0;
  const State end = run_parallel(scene, initial_state(scene), 2);
  for (std::size_t i = 0; i < end.disks.size(); ++i) {
    fastest2 = std::max(fastest2, end.disks.vx[i] * end.disks.vx[i] + end.disks.vy[i] * end.disks.vy[i]);
  }
  EXPECT_GT(fastest2, 100.0 * 100.0);
}

// Parts and regions as large as in real runs.
TEST(LongExactParallelSize, PartsAndRegionsAsTheyAre) {
  const Scene scene = make_scene({285, 285, "periodic", "", random_disks(50000, equal_disks), 0.12, ""});
  const State initial = initial_state(scene);
  const std::string reference = fingerprint(run_reference(scene, initial));
  for (const int threads : test::thread_counts) {
    EXPECT_EQ(fingerprint(run_parallel(scene, initial, threads, 1)), reference) << threads << " threads";
  }
  EXPECT_EQ(fingerprint(run_in_regions(scene, initial, 1)), reference) << "regions";
}

// After release_memory() the engine has only the state and no paths; what it rebuilds gives the same bits.
TEST(ExactParallelMemory, GivenBackChangesNoBit) {
  const Scene scene = make_scene({30, 30, "periodic", "", random_disks(500, mixed_disks), 50.0, ""});
  const State initial = initial_state(scene);
  for (const std::size_t block_divisor : {1U, 128U}) {
    const auto kept = make_parallel_engine(scene, initial, {2, block_divisor});
    const auto released = make_parallel_engine(scene, initial, {2, block_divisor});
    for (int k = 0; k < 12; ++k) {
      kept->step();
      released->step();
      if (k % 3 != 0) continue;
      released->release_memory();
      Disks disks;
      EXPECT_EQ(released->disks_at(0.0, disks), released->state().time);
      EXPECT_EQ(state_hash(disks), state_hash(released->state().disks));
    }
    EXPECT_EQ(fingerprint(released->state()), fingerprint(kept->state()));
  }
}

}  // namespace
}  // namespace carom::exact_tests
