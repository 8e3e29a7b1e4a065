// Initial states made by each rank for its own slab: the disks of a single machine, bit for bit.
#include "parallel/slabs/start_on_slabs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <string>

#include "core/base/check.hpp"
#include "core/base/same_bits.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "tests/support/feature_scenes.hpp"

namespace carom {
namespace {

// box: lines of [box]; rest: groups and all other tables.
Scene scene_of(const std::string& box, const std::string& rest) {
  return parse_scene("[box]\n" + box + rest + "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1.0\n", "scene", "");
}

const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

void expect_same(const Disk& a, const Disk& b) {
  EXPECT_TRUE(same_bits(a.x, b.x) && same_bits(a.y, b.y)) << a.id << " at " << a.x << ", " << a.y;
  EXPECT_TRUE(same_bits(a.vx, b.vx) && same_bits(a.vy, b.vy)) << a.id << " with " << a.vx << ", " << a.vy;
  EXPECT_TRUE(same_bits(a.radius, b.radius) && same_bits(a.mass, b.mass)) << a.id;
  EXPECT_TRUE(same_bits(a.spin, b.spin)) << a.id;
}

// The parts of all ranks together are the state of a single machine, and each part is in its slab.
void expect_parts(const Scene& scene, int count) {
  SCOPED_TRACE(fmt::format("{} ranks", count));
  ASSERT_TRUE(starts_on_slabs(scene));
  const State all = initial_state(scene);
  std::map<DiskId, Disk> expected;
  for (std::size_t i = 0; i < all.disks.size(); ++i) expected[all.disks.id[i]] = disk_at(all.disks, i);
  std::mutex mutex;
  std::size_t disks = 0;
  std::size_t most = 0;
  run_on_local_ranks(count, [&](Ranks& ranks) {
    const std::optional<StartOnSlab> made = start_on_slab(scene, ranks);
    const std::lock_guard lock(mutex);
    ASSERT_TRUE(made.has_value());
    const Disks& d = made->part.disks;
    disks += d.size();
    most = std::max(most, d.size());
    for (std::size_t i = 0; i < d.size(); ++i) {
      ASSERT_TRUE(expected.contains(d.id[i]));
      expect_same(disk_at(d, i), expected[d.id[i]]);
      EXPECT_EQ(made->start.cut.rank_at(d.y[i]), ranks.rank());
    }
    EXPECT_EQ(d.common_radius, all.disks.common_radius);
    EXPECT_EQ(d.common_mass, all.disks.common_mass);
    EXPECT_EQ(d.inertia, all.disks.inertia);
    EXPECT_EQ(made->part.next_id, all.next_id);
    EXPECT_EQ(made->part.sources.size(), all.sources.size());
    EXPECT_EQ(made->part.obstacles.size(), all.obstacles.size());
    const SlabStart one = slab_start(scene, all.disks, count);
    EXPECT_EQ(made->start.disks, one.disks);
    EXPECT_EQ(made->start.smallest_radius, one.smallest_radius);
    EXPECT_EQ(made->start.largest_radius, one.largest_radius);
    EXPECT_EQ(made->start.counts, one.counts);
    EXPECT_EQ(made->start.columns.radius, one.columns.radius);
    EXPECT_EQ(made->start.columns.mass, one.columns.mass);
    EXPECT_EQ(made->start.columns.spin, one.columns.spin);
  });
  EXPECT_EQ(disks, all.disks.size());
  EXPECT_LT(most, 2 * disks / static_cast<std::size_t>(count) + 60) << "unevenly distributed";
}

TEST(StartOnSlabs, IsThatOfOneMachine) {
  const std::string maxwell = "velocities = { maxwell = 2.0 }\n";
  const std::vector<Scene> scenes{
      scene_of(periodic + "packing_fraction = 0.6\n",
               "[[disks]]\ncount = 1000\npositions = \"hexagonal\"\nradius = 0.5\nmass = 1.0\n" + maxwell),
      scene_of("width = 40.0\nheight = 50.0\n",
               "[[disks]]\ncount = 900\npositions = \"square\"\nradius = { uniform = [0.2, 0.5] }\n"
               "mass = { uniform = [1.0, 2.0] }\ndrift = [0.5, -0.25]\n" +
                   maxwell),
      scene_of(periodic + "width = 40.0\nheight = 50.0\nshear_rate = 0.3\n",
               "[[disks]]\ncount = 901\npositions = \"hexagonal\"\nradius = 0.5\nmass = { from_radius = 3.0 }\n"
               "velocities = { uniform = 4.0 }\n"),
      // Lattices above each other, in regions, with sources; rough disks.
      scene_of(
          "width = 40.0\nheight = 60.0\n",
          "[[disks]]\ncount = 300\npositions = \"square\"\nregion = [0.0, 0.0, 40.0, 20.0]\nradius = 0.5\nmass = 1.0\n"
          "spin_temperature = 2.0\n" +
              maxwell +
              "[[disks]]\ncount = 100\npositions = \"hexagonal\"\nregion = [5.0, 30.0, 35.0, 60.0]\nradius = 1.0\n"
              "mass = 2.0\n[[walls]]\npoints = [[1.0, 22.0], [20.0, 28.0]]\n"
              "[physics]\nroughness = { tangential_restitution = 0.5 }\n"),
      scene_of(test::sides_text("moving", 1) + "width = 30.0\nheight = 50.0\n",
               "[[disks]]\ncount = 400\npositions = \"hexagonal\"\nradius = { uniform = [0.3, 0.5] }\nmass = 1.0\n" +
                   maxwell),
  };
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    SCOPED_TRACE(s);
    for (const int count : {1, 2, 3, 4}) expect_parts(scenes[s], count);
  }
}

// A trial is rejected because of the disks that a single machine has placed before, wherever they are, and because of
// no others.
TEST(StartOnSlabs, PlacesAtRandomAsOneMachine) {
  const std::string random = "positions = \"random\"\nradius = 0.5\nvelocities = { maxwell = 2.0 }\n";
  const std::vector<Scene> scenes{
      scene_of(periodic + "packing_fraction = 0.35\n", "[[disks]]\ncount = 5000\nmass = 1.0\n" + random),
      scene_of("width = 40.0\nheight = 90.0\n", "[[disks]]\ncount = 800\nmass = 1.0\n" + random +
                                                    "[[disks]]\ncount = 500\nmass = { uniform = [1.0, 3.0] }\n" +
                                                    random +
                                                    "[[walls]]\npoints = [[1.0, 22.0], [20.0, 28.0], [21.0, 60.0]]\n"),
      scene_of(periodic + "width = 60.0\nheight = 20.0\nshear_rate = 0.3\n",
               "[[disks]]\ncount = 400\nmass = 1.0\n" + random),
      scene_of(test::sides_text("moving", 1) + "width = 30.0\nheight = 50.0\n",
               "[[disks]]\ncount = 400\nmass = 1.0\n" + random +
                   "[[sources]]\nregion = [2.0, 4.0, 10.0, 14.0]\nrate = 7.0\nradius = 1.2\nmass = 1.0\n"),
      // Batches in which most trials conflict with each other, and slabs hardly thicker than what they see of their
      // neighbours.
      scene_of(periodic + "width = 30.0\nheight = 9.0\n", "[[disks]]\ncount = 130\nmass = 1.0\n" + random),
      // Large disks are placed first, whichever group they belong to; many are equally large.
      scene_of(periodic + "width = 40.0\nheight = 60.0\n",
               "[[disks]]\ncount = 700\nmass = 1.0\npositions = \"random\"\nradius = { uniform = [0.1, 0.9] }\n"
               "[[disks]]\ncount = 300\nmass = 1.0\npositions = \"random\"\nradius = 0.3\n"
               "[[disks]]\ncount = 300\nmass = { from_radius = 2.0 }\npositions = \"random\"\nradius = 0.3\n"),
      scene_of(
          "width = 40.0\nheight = 160.0\n",
          "[[disks]]\ncount = 3\nmass = 9.0\npositions = \"random\"\nradius = 5.0\nvelocities = { maxwell = 2.0 }\n"
          "[[disks]]\ncount = 2400\nmass = 1.0\n" +
              random),
  };
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    SCOPED_TRACE(s);
    for (const int count : {1, 2, 3, 4}) expect_parts(scenes[s], count);
  }
}

// If many trials fail, a single machine learns where there is room: which cells are open, from a packing fraction of
// about 0.39 on, and then a list of voxels, which is refined and reduced. Ranks learn the same after the same disks.
TEST(LongStartOnSlabs, LearnsWhereThereIsRoom) {
  const std::string random = "mass = 1.0\npositions = \"random\"\nradius = 0.5\n";
  const std::vector<Scene> scenes{
      scene_of(periodic + "packing_fraction = 0.41\n", "[[disks]]\ncount = 2500\n" + random),
      scene_of(periodic + "packing_fraction = 0.5\n", "[[disks]]\ncount = 3000\n" + random),
      scene_of(periodic + "packing_fraction = 0.53\n", "[[disks]]\ncount = 1500\n" + random),
      scene_of(periodic + "packing_fraction = 0.546\n", "[[disks]]\ncount = 300\n" + random),
      // A channel that is not dense.
      scene_of("width = 3.0\nheight = 2000.0\n", "[[disks]]\ncount = 2950\n" + random),
      // Walls and inner walls, and a box whose height is not a whole number of voxels.
      scene_of("width = 40.3\nheight = 61.7\n", "[[disks]]\ncount = 1420\n" + random +
                                                    "[[walls]]\npoints = [[1.0, 22.0], [20.0, 28.0], [21.0, 60.0]]\n"),
      scene_of(test::sides_text("moving", 1) + "width = 30.0\nheight = 50.0\n", "[[disks]]\ncount = 800\n" + random),
      // Slabs hardly thicker than what they see of their neighbours.
      scene_of(periodic + "width = 60.0\nheight = 9.0\n", "[[disks]]\ncount = 340\n" + random),
      // Unequal disks: one class that learns, two that do, one large and one small disk.
      scene_of(periodic + "packing_fraction = 0.6\n",
               "[[disks]]\ncount = 2500\nmass = 1.0\npositions = \"random\"\nradius = { uniform = [0.3, 0.55] }\n"),
      scene_of(periodic + "packing_fraction = 0.66\n",
               "[[disks]]\ncount = 500\n" + random +
                   "[[disks]]\ncount = 3000\nmass = 1.0\npositions = \"random\"\nradius = 0.11\n"),
      scene_of("width = 40.0\nheight = 60.0\n",
               "[[disks]]\ncount = 1400\n" + random +
                   "[[disks]]\ncount = 1200\nmass = 1.0\npositions = \"random\"\nradius = { uniform = [0.2, 0.24] }\n"),
  };
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    SCOPED_TRACE(s);
    for (const int count : {1, 2, 3, 4}) expect_parts(scenes[s], count);
  }
}

// If there is no room for the last disk, the error comes from a single machine.
TEST(StartOnSlabs, LeavesJammedDisksToOneMachine) {
  const Scene scene = scene_of("width = 12.0\nheight = 40.0\n",
                               "[[disks]]\ncount = 333\npositions = \"random\"\nradius = 0.5\nmass = 1.0\n");
  ASSERT_TRUE(starts_on_slabs(scene));
  EXPECT_THROW(initial_state(scene), InputError);
  run_on_local_ranks(3, [&](Ranks& ranks) { EXPECT_FALSE(start_on_slab(scene, ranks).has_value()); });
}

TEST(StartOnSlabs, LeavesTooManyDisksToOneMachine) {
  EXPECT_FALSE(
      starts_on_slabs(scene_of(periodic + "packing_fraction = 0.56\n",
                               "[[disks]]\npositions = \"random\"\nmass = 1.0\ncount = 4000\nradius = 0.5\n")));
}

// Errors come from a single machine: it finds which disks overlap.
TEST(StartOnSlabs, LeavesWhatIsRefusedToOneMachine) {
  const std::vector<Scene> scenes{
      // The second lattice lies on the first.
      scene_of("width = 40.0\nheight = 60.0\n",
               "[[disks]]\ncount = 300\npositions = \"square\"\nradius = 0.5\nmass = 1.0\n"
               "[[disks]]\ncount = 10\npositions = \"square\"\nradius = 0.5\nmass = 1.0\n"),
      scene_of("width = 10.0\nheight = 10.0\n",
               "[[disks]]\ncount = 200\npositions = \"square\"\nradius = 0.5\nmass = 1.0\n"),
      scene_of("width = 40.0\nheight = 4.0\n",
               "[[disks]]\ncount = 20\npositions = \"square\"\nradius = 0.5\nmass = 1.0\n"),
  };
  for (const Scene& scene : scenes) {
    ASSERT_TRUE(starts_on_slabs(scene));
    run_on_local_ranks(3, [&](Ranks& ranks) { EXPECT_FALSE(start_on_slab(scene, ranks).has_value()); });
  }
}

TEST(StartOnSlabs, KnowsWhatItCannotMake) {
  const auto disks = [](const std::string& lines) {
    return "[[disks]]\ncount = 20\nradius = 0.5\nmass = 1.0\n" + lines;
  };
  for (const std::string lines :
       {"positions = \"random\"\nregion = [0.0, 0.0, 20.0, 20.0]\n",
        "positions = \"square\"\n[[disks]]\ncount = 1\nradius = 0.5\nmass = 1.0\npositions = \"random\"\n",
        "positions = \"growth\"\n", "positions = \"square\"\nregion = { circle = [20.0, 20.0, 10.0] }\n"}) {
    EXPECT_FALSE(starts_on_slabs(scene_of("width = 40.0\nheight = 40.0\n", disks(lines)))) << lines;
  }
}

}  // namespace
}  // namespace carom
