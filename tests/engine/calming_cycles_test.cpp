// Additional cycles of the solver for high piles that tremble (core/physics/support_solver.hpp).
#include <gtest/gtest.h>

#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/physics/support_solver.hpp"
#include "core/reference/reference_pairwise.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr double fall = 0.005;

// A column of n disks of mass 1 at rest: contact k bears the weight of the disks above it.
SupportTotals totals_of_column(int n) {
  SupportTotals totals;
  for (int k = 0; k < n; ++k) totals.add(fall * static_cast<double>(n - k), 0.5);
  return totals;
}

TEST(CalmingCycles, GrowWithTheHeightOfThePile) {
  const double trembling = 1e-4 * fall * fall;  // a hundredth of g dt for each disk, squared, times the mass
  EXPECT_EQ(calming_cycles(totals_of_column(50), fall, 25.0 * trembling).most, 10);
  EXPECT_EQ(calming_cycles(totals_of_column(400), fall, 200.0 * trembling).most, 80);
  EXPECT_EQ(calming_cycles(totals_of_column(5000), fall, 2500.0 * trembling).most, most_cycles);
}

TEST(CalmingCycles, AreNotForDisksThatLand) {
  EXPECT_EQ(calming_cycles(totals_of_column(400), fall, 800.0 * fall * fall).most, 0);
}

// A leaning column on which the last disks fall: the reference and the engine on any number of threads have the same
// bits.
TEST(CalmingCycles, OfTheEngineAreTheReferences) {
  Scene scene = test::scene_of(Method::pairwise, 2.2, 900.0, 0.005, 1.0);
  scene.physics.gravity = 1.0;
  scene.physics.restitution = 0.5;
  scene.box.restitutions.fill(0.5);
  std::vector<Disk> list;
  for (int k = 0; k < 300; ++k) list.push_back({k % 2 == 0 ? 1.0 : 1.2, 1.0 + 1.99 * k, 0.0, 0.0, 1.0, 1.0 + k % 3});
  list.push_back({1.1, 1.0 + 1.99 * 300 + 0.2, 0.0, 0.0, 1.0, 1.0});
  const State start = test::state_of(scene, list);
  const auto hash_of = [](Engine& engine) {
    for (int k = 0; k < 150; ++k) engine.step();
    return state_hash(engine.state().disks);
  };
  const auto expected = hash_of(*make_reference_pairwise(scene, start));
  EXPECT_EQ(hash_of(*make_parallel_engine(scene, start, {1, 1})), expected);
  EXPECT_EQ(hash_of(*make_parallel_engine(scene, start, {2, 16})), expected);
}

}  // namespace
}  // namespace carom
