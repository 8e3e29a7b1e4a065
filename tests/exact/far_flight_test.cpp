// Disks that fly far within one window: across the border of a periodic box, so that the coordinates of their paths
// differ by a period from those of the disks they meet there; or over a quarter of the box, where a path is cut.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/reference/reference_exact.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

// Dilute gases in which flights of the first kind once went wrong: in one of some thousand windows a collision was
// missed.
Scene gas_of_light_and_heavy(int seed, int count, int side, bool falls) {
  return parse_scene(fmt::format(R"(seed = {0}
[box]
width = {2}
height = {2}
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
[physics]
{3}
[[disks]]
count = {1}
positions = "random"
velocities = {{ maxwell = 1.0 }}
radius = 0.5
mass = {{ uniform = [0.05, 4] }}
[run]
method = "exact"
t_end = 1e6
)",
                                 seed, count, side, falls ? "gravity = [0.01, 0.01]" : ""),
                     "test", ".");
}

struct FarFlight {
  int seed, count, side;
  bool falls;
  int window;  // the window in which a collision was missed
};

class ExactFarFlight : public testing::TestWithParam<FarFlight> {};

// The window is run with lists that have been in use for long, and with lists just built.
TEST_P(ExactFarFlight, IsAsTheReferenceHasIt) {
  const FarFlight& c = GetParam();
  const Scene scene = gas_of_light_and_heavy(c.seed, c.count, c.side, c.falls);
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1});
  for (int k = 0; k < c.window; ++k) engine->step();
  const State start = engine->state();
  const auto reference = make_reference_exact(scene, start);
  const auto fresh = make_parallel_engine(scene, start, {1});
  const auto on_threads = make_parallel_engine(scene, start, {3, 128});
  for (int k = 0; k < 2; ++k) {
    for (Engine* e : {engine.get(), fresh.get(), on_threads.get(), reference.get()}) e->step();
    const auto right = state_hash(reference->state().disks);
    EXPECT_EQ(state_hash(engine->state().disks), right);
    EXPECT_EQ(state_hash(fresh->state().disks), right);
    EXPECT_EQ(state_hash(on_threads->state().disks), right);
    EXPECT_EQ(engine->state().counters.collisions, reference->state().counters.collisions);
  }
}

INSTANTIATE_TEST_SUITE_P(Gases, ExactFarFlight,
                         testing::Values(FarFlight{5042, 1214, 99, false, 32}, FarFlight{5316, 1446, 130, false, 24},
                                         FarFlight{223, 1315, 106, true, 49}, FarFlight{293, 1315, 106, true, 50}),
                         [](const auto& p) { return fmt::format("Seed{}", p.param.seed); });

// A few disks that a shear makes ever faster. A prediction kept from an earlier window does not say where the path has
// to be cut once the path has become long enough for that. Without the cut the position at its end is rounded
// differently.
TEST(ExactFastFlight, IsCutWhereLaterWindowsBringItSoFar) {
  for (const auto& [seed, count, rate] : {std::tuple{1, 28, 0.5}, {2, 20, 0.5}, {7, 20, 0.3}}) {
    const Scene scene = parse_scene(fmt::format(R"(seed = {}
[box]
width = 6
height = 10
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
shear_rate = {}
[[disks]]
count = {}
positions = "random"
drift = [-1, 1]
radius = 0.47
mass = 1
[run]
method = "exact"
t_end = 16
)",
                                                seed, rate, count),
                                    "test", ".");
    std::vector<State> states{initial_state(scene)};
    const auto reference = make_reference_exact(scene, states[0]);
    while (reference->state().time < scene.run.t_end) {
      reference->step();
      states.push_back(reference->state());
    }
    // Lists are rebuilt every few windows; which windows depends on where the engine starts.
    for (std::size_t first = 8; first < 12; ++first) {
      const auto engine = make_parallel_engine(scene, states[first], {1});
      for (std::size_t k = first + 1; k < states.size(); ++k) {
        engine->step();
        ASSERT_EQ(state_hash(engine->state().disks), state_hash(states[k].disks)) << seed << ", " << first << ", " << k;
      }
    }
  }
}

}  // namespace
}  // namespace carom::exact_tests
