// Pairs by distance that the ranks count, each among the disks of its slab and at its borders: those of one machine.
#include "parallel/slabs/slab_pairs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/leading_support.hpp"

namespace carom {
namespace {

Scene scene_with(const std::string& method, const std::string& sides, int height, const std::string& pairs) {
  return parse_scene(
      fmt::format("[box]\nwidth = 12.0\nheight = {}\n{}[[disks]]\nname = \"few\"\ncount = {}\npositions = \"random\"\n"
                  "radius = 0.3\nmass = 1.0\nvelocities = {{ maxwell = 2.0 }}\n[[disks]]\nname = \"many\"\ncount = {}\n"
                  "positions = \"random\"\nradius = {{ uniform = [0.4, 0.6] }}\nmass = 1.0\n"
                  "velocities = {{ maxwell = 1.0 }}\n[run]\nmethod = \"{}\"\ndt = 0.02\nt_end = 0.4\n[analysis]\n"
                  "what = [\"pair_correlation\"]\n{}\n",
                  height, sides, height, 4 * height, method, pairs),
      "scene", "");
}

// In steps of a run on so many ranks, also at times within them. Returns how often the ranks could count.
int expect_pairs_of_one_machine(const Scene& scene, int ranks) {
  const State start = initial_state(scene);
  int counted = 0;
  test::on_ranks(ranks, scene, start, [&](RankLead& lead) {
    const auto expected = make_parallel_engine(scene, start, {1});
    const auto engine = lead.make_engine(scene, start, {1, 512}, test::the_start);
    for (double before = 0.0; before < scene.run.t_end; before = engine->progress().time) {
      engine->step();
      expected->step();
      const double t = 0.5 * (before + engine->progress().time);
      Disks there, room;
      const double time = expected->disks_at(t, there);
      const auto pairs = engine->pieces_at(t, room)->pair_counts();
      if (!pairs) continue;
      ++counted;
      const auto all = pairs_of_plan(scene.analysis, there, box_at(scene.box, time), count_pairs);
      ASSERT_EQ(pairs->size(), all.size());
      for (std::size_t k = 0; k < all.size(); ++k) {
        EXPECT_EQ((*pairs)[k].centres, all[k].centres) << k;
        EXPECT_EQ((*pairs)[k].counts, all[k].counts) << k;
      }
    }
  });
  return counted;
}

const std::string walls;
const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

const std::string of_groups = "pair_correlation = { r_max = 4.0, bins = 40, groups = [\"few\", \"many\"] }";
const std::string of_some = "select = \"few\"\npair_correlation = { r_max = 3.0, bins = 7 }";
const std::string far = "pair_correlation = { r_max = 3.3, bins = 40 }";

TEST(SlabPairs, AreThoseOfOneMachine) {
  for (const std::string& sides : {walls, periodic}) {
    for (const std::string& pairs : {of_groups, of_some}) {
      for (const int ranks : {1, 2, 3, 4}) {
        EXPECT_EQ(expect_pairs_of_one_machine(scene_with("pairwise", sides, 60, pairs), ranks), 20) << ranks;
      }
    }
    EXPECT_GT(expect_pairs_of_one_machine(scene_with("exact", sides, 400, of_groups), 3), 0);
    // Each of two thin slabs sees the other across both borders.
    EXPECT_EQ(expect_pairs_of_one_machine(scene_with("pairwise", sides, 8, far), 2), 20);
  }
}

// Pairs of ranks that are no neighbours, and images above that are displaced: all disks are needed.
TEST(SlabPairs, AreLeftToOthersWhereSlabsAreThinOrSheared) {
  EXPECT_EQ(expect_pairs_of_one_machine(scene_with("pairwise", walls, 12, far), 4), 0);
  EXPECT_EQ(expect_pairs_of_one_machine(scene_with("pairwise", periodic + "shear_rate = 0.1\n", 60, far), 2), 0);
}

}  // namespace
}  // namespace carom
