// Hashes of known runs. They are the same for release and debug builds, for g++ and clang, for reference and engine. If
// one of them changes the physics has changed: find out why before writing down the new hash.
#include <gtest/gtest.h>

#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/feature_scenes.hpp"

namespace carom {
namespace {

struct Golden {
  test::Features features;
  const char* hash;
};

constexpr int steps = 40;

std::string hash_of(Engine& engine) {
  for (int k = 0; k < steps; ++k) engine.step();
  return hash_text(state_hash(engine.state().disks));
}

TEST(GoldenHash, OfSmallRunsWithManyFeatures) {
  const std::vector<Golden> runs{
      {{"pairwise", "periodic", false, 1.0, "", "equal", false, false, 1}, "9167fb14571f3c7d"},
      {{"pairwise", "wall", true, 0.7, "", "mixed", true, false, 2}, "7a96f080ca441ee6"},
      {{"pairwise", "sink", false, 1.0, "replace", "wide", true, true, 3}, "2280d0d1af7bb74b"},
      {{"pairwise", "periodic_x", true, 1.0, "accumulate", "mixed", false, true, 4}, "da15d23a0028f4af"},
      {{"rollback", "wall", false, 1.0, "", "mixed", true, false, 5}, "6ec16e8ebd369f7e"},
      {{"rollback", "periodic_x", true, 0.7, "replace", "equal", true, false, 6}, "ce1a78ecd8400f71"},
      {{"exact", "periodic", false, 1.0, "", "equal", false, false, 7}, "7d269746473097ff"},
      {{"exact", "wall", true, 1.0, "", "mixed", true, false, 8}, "72cfd77bb259e174"},
      {{"exact", "sink", false, 1.0, "replace", "wide", true, true, 9}, "0fb48dc7845e918b"},
      {{"exact", "periodic_x", true, 1.0, "accumulate", "equal", false, true, 10}, "2820ba7aaf543f43"},
  };
  for (const Golden& run : runs) {
    SCOPED_TRACE(run.features.name());
    const Scene scene = test::feature_scene(run.features, steps);
    const State start = initial_state(scene);
    EXPECT_EQ(hash_of(*make_reference_engine(scene, start)), run.hash);
    EXPECT_EQ(hash_of(*make_parallel_engine(scene, start, {2, 512})), run.hash);
  }
}

TEST(GoldenHash, OfTheOriginalsFirstScene) {
  const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/two_disks.toml");
  const auto engine = make_reference_engine(scene, initial_state(scene));
  while (engine->state().time < scene.run.t_end) engine->step();
  EXPECT_EQ(hash_text(state_hash(engine->state().disks)), "45cd2a0d74f18e22");
}

}  // namespace
}  // namespace carom
