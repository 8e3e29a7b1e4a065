// Disks that fly far into a periodic box through its border within one window: their paths have other coordinates than
// the disks they meet there. Dilute gases of light disks among heavy ones, in which that was seen to go wrong: a
// collision was missed in one window of some thousand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/disks/state_hash.hpp"
#include "core/reference/reference_exact.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

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
  int window;  // in which a collision was missed
};

class ExactFarFlight : public testing::TestWithParam<FarFlight> {};

// The window's lists are some that have been in use for long, and some that have just been built.
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

}  // namespace
}  // namespace carom::exact_tests
