// Of two disks either each lists the other, or neither does: whichever of them starts a new path predicts their
// contact. This must hold when disks are relisted while their neighbours belong to other threads.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "parallel/exact/border_watch.hpp"
#include "parallel/exact/exact_engine.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

struct Seen {
  int slices = 0;
  int one_sided = 0;  // entries of lists without the opposite entry
};

bool lists(const NeighbourLists& all, std::uint32_t i, std::uint32_t j) {
  bool found = false;
  all.for_each_neighbour(i, [&](std::uint32_t k) { found = found || k == j; });
  return found;
}

Seen look_at_each_slice(const std::string& sides, int threads, int windows) {
  SceneText text;
  text.width = 48.0;
  text.height = 44.0;
  text.sides = sides;
  text.disks =
      "[[disks]]\ncount = 800\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1\n";
  text.t_end = 1000.0;
  const Scene scene = make_scene(text);
  Seen seen;
  const auto watch = [&](const SliceBorders& slice) {
    ++seen.slices;
    for (std::uint32_t i = 0; i < slice.window.record.size(); ++i) {
      slice.lists.for_each_neighbour(i, [&](std::uint32_t j) { seen.one_sided += lists(slice.lists, j, i) ? 0 : 1; });
    }
  };
  const auto engine = make_parallel_exact(scene, initial_state(scene), {threads, 256}, watch);
  for (int k = 0; k < windows; ++k) engine->step();
  return seen;
}

TEST(LongMutualLists, AfterEverySlice) {
  for (const char* sides : {"wall", "periodic"}) {
    for (const int threads : {1, 3}) {
      SCOPED_TRACE(testing::Message() << sides << ", " << threads << " threads");
      const Seen seen = look_at_each_slice(sides, threads, 60);
      EXPECT_GT(seen.slices, 600);
      EXPECT_EQ(seen.one_sided, 0);
    }
  }
}

}  // namespace
}  // namespace carom::exact_tests
