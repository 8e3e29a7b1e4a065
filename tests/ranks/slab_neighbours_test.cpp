// Quantities of neighbours that ranks compute from the disks of their slabs and at the borders are those of a single
// machine: pairs by distance, psi6, and its correlation over distance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/load/scene_file.hpp"
#include "core/measure/bond_correlation.hpp"
#include "core/measure/bond_order.hpp"
#include "core/measure/measured_disks.hpp"
#include "core/measure/pair_records.hpp"
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
                  "what = [\"pair_correlation\", \"bond_correlation\"]\n"
                  "bond_correlation = {{ r_max = 2.5, bins = 20 }}\n{}\n",
                  height, sides, height, 4 * height, method, pairs),
      "scene", "");
}

// Returns whether the ranks could count.
bool expect_pairs(const DisksInPieces& pieces, const Disks& there, const Scene& scene) {
  const auto pairs = pieces.pair_counts();
  if (!pairs) return false;
  const auto all = pairs_of_plan(scene.analysis, there, box_at(scene.box, pieces.time()), run_in_order);
  EXPECT_EQ(pairs->size(), all.size());
  for (std::size_t k = 0; k < std::min(pairs->size(), all.size()); ++k) {
    EXPECT_EQ((*pairs)[k].centres, all[k].centres) << k;
    EXPECT_EQ((*pairs)[k].counts, all[k].counts) << k;
  }
  return true;
}

// The same for psi6, bit for bit.
bool expect_orders(const DisksInPieces& pieces, const Disks& there, const Scene& scene) {
  const AnalysisPlan& plan = scene.analysis;
  const Disks measured = plan.group.empty() ? there : disks_of(there, plan.ids);
  const Disks expected = with_orders(measured, bond_orders(measured, box_at(scene.box, pieces.time())));
  const std::vector<std::size_t> order = by_id(expected);
  std::size_t next = 0;
  const bool known = pieces.visit_orders([&](const Disks& psi) {
    for (const std::size_t i : by_id(psi)) {
      ASSERT_LT(next, order.size());
      const std::size_t k = order[next++];
      EXPECT_EQ(psi.id[i], expected.id[k]);
      EXPECT_EQ(psi.vx[i], expected.vx[k]);
      EXPECT_EQ(psi.vy[i], expected.vy[k]);
    }
  });
  EXPECT_EQ(next, known ? order.size() : 0);
  return known;
}

// And for the pairs that enter its correlation over distance.
bool expect_bonds(const DisksInPieces& pieces, const Disks& there, const Scene& scene) {
  const AnalysisPlan& plan = scene.analysis;
  const auto bonds = pieces.bond_pairs();
  if (!bonds) return false;
  const Domain box = box_at(scene.box, pieces.time());
  const Disks measured = plan.group.empty() ? there : disks_of(there, plan.ids);
  const BondPairs all = bond_pairs(with_orders(measured, bond_orders(measured, box)), box, distance_bins(plan.bonds));
  EXPECT_EQ(bonds->counts, all.counts);
  EXPECT_EQ(bonds->product.size(), all.product.size());
  for (std::size_t k = 0; k < std::min(bonds->product.size(), all.product.size()); ++k) {
    EXPECT_EQ(bonds->product[k].high, all.product[k].high) << k;
    EXPECT_EQ(bonds->product[k].low, all.product[k].low) << k;
  }
  return true;
}

struct Known {
  int pairs = 0, orders = 0, bonds = 0;
};

// Compares in the steps of a run on this number of ranks, and at times within steps. Returns how often the ranks could
// tell.
Known expect_those_of_one_machine(const Scene& scene, int ranks) {
  const State start = initial_state(scene);
  Known known;
  test::on_ranks(ranks, scene, start, [&](RankLead& lead) {
    const auto expected = make_parallel_engine(scene, start, {1});
    const auto engine = lead.make_engine(scene, start, {1, 512}, test::the_start);
    for (double before = 0.0; before < scene.run.t_end; before = engine->progress().time) {
      engine->step();
      expected->step();
      const double t = 0.5 * (before + engine->progress().time);
      Disks there, room;
      expected->disks_at(t, there);
      const auto pieces = engine->pieces_at(t, room);
      known.pairs += expect_pairs(*pieces, there, scene) ? 1 : 0;
      known.orders += expect_orders(*pieces, there, scene) ? 1 : 0;
      known.bonds += expect_bonds(*pieces, there, scene) ? 1 : 0;
    }
  });
  return known;
}

const std::string walls;
const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

const std::string of_groups = "pair_correlation = { r_max = 4.0, bins = 40, groups = [\"few\", \"many\"] }";
const std::string of_some = "select = \"few\"\npair_correlation = { r_max = 3.0, bins = 7 }";
const std::string far = "pair_correlation = { r_max = 3.3, bins = 40 }";

TEST(SlabNeighbours, AreThoseOfOneMachine) {
  for (const std::string& sides : {walls, periodic}) {
    for (const std::string& pairs : {of_groups, of_some}) {
      for (const int ranks : {1, 2, 3, 4}) {
        const Known known = expect_those_of_one_machine(scene_with("pairwise", sides, 60, pairs), ranks);
        EXPECT_EQ(known.pairs, 20) << ranks;
        // These few disks are so far apart that with thin slabs they look for neighbours beyond the next slab.
        if (pairs == of_some && ranks > 2) continue;
        EXPECT_EQ(known.orders, 20) << ranks;
        EXPECT_EQ(known.bonds, 20) << ranks;
      }
    }
    const Known exact = expect_those_of_one_machine(scene_with("exact", sides, 400, of_groups), 3);
    EXPECT_GT(exact.pairs, 0);
    EXPECT_EQ(exact.pairs, exact.orders);
    EXPECT_EQ(exact.pairs, exact.bonds);
    // Each of two thin slabs sees the other across both borders.
    EXPECT_EQ(expect_those_of_one_machine(scene_with("pairwise", sides, 8, far), 2).pairs, 20);
  }
}

// The images above a sheared box are displaced, in the end by more than its width.
TEST(SlabNeighbours, AreThoseOfOneMachineInAShearFlow) {
  const std::string shear = periodic + "shear_rate = 0.7\n";
  for (const int ranks : {1, 2, 3, 4}) {
    const Known known = expect_those_of_one_machine(scene_with("pairwise", shear, 60, far), ranks);
    EXPECT_EQ(known.pairs, 20) << ranks;
    EXPECT_EQ(known.orders, 20) << ranks;
    EXPECT_EQ(known.bonds, 20) << ranks;
  }
  EXPECT_EQ(expect_those_of_one_machine(scene_with("pairwise", shear, 8, far), 2).bonds, 20);
}

// The neighbours belong to ranks that are not adjacent, so all disks are needed.
TEST(SlabNeighbours, AreLeftToOthersWhereSlabsAreThin) {
  const Known thin = expect_those_of_one_machine(scene_with("pairwise", walls, 12, far), 4);
  EXPECT_EQ(thin.pairs + thin.orders + thin.bonds, 0);
}

}  // namespace
}  // namespace carom
