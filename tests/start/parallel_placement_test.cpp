// Random sequential addition in parallel has the bits of the plain version, for any number of threads and any blocks.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/disks/state_hash.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/start/random_placement.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::scene_from;

State placed_in_parallel(const Scene& scene, int threads, std::size_t divisor) {
  const Executor executor(threads, divisor);
  return initial_state(scene, [&](const Scene& s, Disks& disks, PlacementGrid& grid, std::vector<std::uint32_t> m) {
    parallel_place_at_random(executor, s, disks, grid, std::move(m));
  });
}

std::string scene_text(std::string_view box, std::string_view groups) {
  return fmt::format("seed = 11\n[box]\n{}\n{}\n[run]\nt_end = 1\n", box, groups);
}

struct Case {
  const char* name;
  const char* box;
  const char* groups;
};

constexpr const char* periodic =
    "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";
constexpr const char* walls = "aspect = 3\n";

// Dilute, and close to jamming (0.547), where open cells are listed and listed again; mixed sizes, in classes; disks
// already placed; few disks; a box only a few cells wide.
const std::vector<Case> cases{
    {"loose", periodic,
     "packing_fraction = 0.3\n[[disks]]\ncount = 20000\npositions = \"random\"\nradius = 1\nmass = 1"},
    {"dense", periodic,
     "packing_fraction = 0.54\n[[disks]]\ncount = 12000\npositions = \"random\"\nradius = 1\nmass = 1"},
    {"dense_walls", walls,
     "packing_fraction = 0.52\n[[disks]]\ncount = 3000\npositions = \"random\"\nradius = 1\nmass = 1"},
    {"mixed", periodic,
     "packing_fraction = 0.6\n[[disks]]\ncount = 6000\npositions = \"random\"\nradius = { uniform = [0.1, 1] }\nmass = "
     "1"},
    {"among_fixed", "width = 60\nheight = 60\n",
     "[[disks]]\ncount = 36\npositions = \"square\"\nradius = 4\nmass = 1\n[[disks]]\ncount = 700\npositions = "
     "\"random\"\n"
     "radius = 0.5\nmass = 1"},
    {"few", periodic, "packing_fraction = 0.4\n[[disks]]\ncount = 7\npositions = \"random\"\nradius = 1\nmass = 1"},
    {"strip", "width = 400\nheight = 5\nbottom = \"periodic\"\ntop = \"periodic\"\n",
     "[[disks]]\ncount = 250\npositions = \"random\"\nradius = 1\nmass = 1"}};

TEST(ParallelPlacement, SameBitsAsThePlainSearch) {
  for (const Case& c : cases) {
    const Scene scene = scene_from(scene_text(c.box, c.groups));
    const State expected = initial_state(scene);
    for (const int threads : {1, 2, 5}) {
      const State state = placed_in_parallel(scene, threads, threads == 5 ? 100 : 1);
      EXPECT_EQ(state.disks.x, expected.disks.x) << c.name << ", " << threads;
      EXPECT_EQ(state.disks.y, expected.disks.y) << c.name << ", " << threads;
    }
  }
}

// So many disks that the list of free places, at most four per disk, is refined in place, a quarter of a million at a
// time.
TEST(LongParallelPlacement, SameBitsWhereTheListIsRefinedInParts) {
  const Scene scene = scene_from(scene_text(
      periodic, "packing_fraction = 0.53\n[[disks]]\ncount = 100000\npositions = \"random\"\nradius = 1\nmass = 1"));
  const State expected = initial_state(scene);
  const State state = placed_in_parallel(scene, 2, 1);
  EXPECT_EQ(state_hash(state.disks), state_hash(expected.disks));
}

TEST(ParallelPlacement, JammedScenesEndWithTheSameMessage) {
  const Scene scene = scene_from(scene_text(
      periodic, "packing_fraction = 0.6\n[[disks]]\ncount = 150\npositions = \"random\"\nradius = 1\nmass = 1"));
  const auto words = [](auto&& make) {
    try {
      make();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string expected = words([&] { initial_state(scene); });
  EXPECT_THAT(expected, testing::HasSubstr("finds no room"));
  EXPECT_EQ(words([&] { placed_in_parallel(scene, 2, 1); }), expected);
}

}  // namespace
}  // namespace carom
