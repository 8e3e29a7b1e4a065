// A run that is interrupted and resumed, by either engine and with any number of threads, has the bits of a run that
// was never stopped: for every method, with a sample of the combinations of features (all of them:
// resume_validation.cpp).
#include <tuple>

#include "tests/support/resume_support.hpp"

namespace carom {
namespace {

class Resume : public ::testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(Resume, HasTheBitsOfARunThatWasNeverStopped) {
  constexpr const char* sides[] = {"wall", "periodic", "periodic_x", "sink", "hot", "moving"};
  const auto [method, k] = GetParam();
  test::expect_same_bits(method, sides[k], static_cast<std::size_t>(k), 7);
}

std::string method_and_number(const ::testing::TestParamInfo<std::tuple<const char*, int>>& p) {
  return std::string(std::get<0>(p.param)) + std::to_string(std::get<1>(p.param));
}

INSTANTIATE_TEST_SUITE_P(AllScenes, Resume,
                         ::testing::Combine(::testing::Values("pairwise", "rollback", "exact"), ::testing::Range(4, 6)),
                         method_and_number);
INSTANTIATE_TEST_SUITE_P(LongAllScenes, Resume,
                         ::testing::Combine(::testing::Values("pairwise", "rollback", "exact"), ::testing::Range(0, 4)),
                         method_and_number);

TEST(ResumeTilted, WithGravityAsAVector) {
  for (const char* method : {"pairwise", "rollback", "exact"}) {
    test::Features f;
    f.method = method;
    f.gravity = f.tilted = f.obstacles = true;
    f.radii = "mixed";
    const Scene scene = test::feature_scene(f, 20);
    const State start = initial_state(scene);
    const Scene longer = test::feature_scene(f, 40);
    test::expect_same_bits(longer, start, 12, 0);
  }
}

TEST(ResumeThermostat, GoesOnWithItsKicks) {
  for (const char* method : {"pairwise", "rollback", "exact"}) {
    for (const char* kind : {"langevin", "andersen"}) {
      test::Features f;
      f.method = method;
      f.thermostat = kind;
      const Scene scene = test::feature_scene(f, 40);
      test::expect_same_bits(scene, initial_state(scene), 12, 0);
    }
  }
}

// A pile at rest with loads; each step starts from the loads of the step before.
TEST(ResumePile, GoesOnWithItsLoads) {
  test::Features f;
  f.gravity = true;
  f.restitution = 0.4;
  f.radii = "mixed";
  const Scene scene = test::feature_scene(f, 300);
  const auto engine = make_reference_engine(scene, initial_state(scene));
  while (engine->state().time < scene.run.t_end) engine->step();
  const State settled = engine->state();
  ASSERT_GT(settled.loads.size(), 50U);
  const Scene longer = test::feature_scene(f, 330);
  test::expect_same_bits(longer, settled, settled.counters.steps + 30, 0);
}

// A failed step leaves a state from which it fails again in the same way: no part of it may be done twice.
TEST(ResumeFailed, AStepThatFailedChangesNothingMore) {
  for (const char* method : {"pairwise", "rollback"}) {
    test::Features f;
    f.method = method;
    f.diffusion = "accumulate";
    f.source = true;
    Scene scene = test::feature_scene(f, 5);
    scene.physics.diffusion = 1e7;  // too fast for any number of parts
    const auto engine = make_parallel_engine(scene, initial_state(scene), {2, 512});
    EXPECT_ANY_THROW(engine->step());
    const std::string left = test::all_bits(engine->state());
    EXPECT_ANY_THROW(engine->step());
    EXPECT_EQ(test::all_bits(engine->state()), left) << method;
    const auto other = make_reference_engine(scene, engine->state());
    EXPECT_ANY_THROW(other->step());
    EXPECT_EQ(test::all_bits(other->state()), left) << method;
  }
}

}  // namespace
}  // namespace carom
