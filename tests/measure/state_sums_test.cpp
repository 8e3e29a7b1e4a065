// The sums over all disks for a summary, compared with numbers by hand, from disks in two pieces.
#include "core/measure/state_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/disks/state_hash.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

// In a flow of 0.1 (y - 5) masses of 2 and 4 have velocities (3, 4) and (0, 2) relative to it.
TEST(StateSums, AreOfAllPieces) {
  Scene scene;
  scene.box = test::box_of(20.0, 10.0, test::Periodic::both);
  scene.box.shear = {0.1, 1.0, 0.0};
  Disks first, second;
  append(first, {5.0, 2.5, 2.75, 4.0, 0.25, 2.0, 0});
  append(second, {15.0, 7.5, 0.25, 2.0, 0.5, 4.0, 3});
  Disks both = first;
  append(both, disk_at(second, 0));
  StateTally tally(scene, 7.0);
  tally.add(first, by_id(first));
  tally.add(Disks{}, {});
  tally.add(second, by_id(second));
  const StateSums sums = tally.sums();
  EXPECT_EQ(sums.at.time, 7.0);
  EXPECT_EQ(sums.at.particles, 2U);
  EXPECT_DOUBLE_EQ(sums.at.relative, 25.0 + 8.0);
  EXPECT_DOUBLE_EQ(sums.at.energy.kinetic, (2.75 * 2.75 + 16.0) + 2.0 * (0.0625 + 4.0));
  EXPECT_DOUBLE_EQ(sums.at.momentum.x, 2.0 * 2.75 + 4.0 * 0.25);
  EXPECT_DOUBLE_EQ(sums.at.momentum.y, 2.0 * 4.0 + 4.0 * 2.0);
  EXPECT_EQ(sums.smallest_radius, 0.25) << "the smallest disk is in the first piece";
  EXPECT_DOUBLE_EQ(sums.fastest, std::hypot(2.75, 4.0)) << "likewise";
  EXPECT_EQ(sums.hash, state_hash(both));
  scene.box.shear = {};
  StateTally still(scene, 7.0);
  still.add(both, by_id(both));
  EXPECT_EQ(still.sums().at.relative, sums.at.energy.kinetic) << "without a flow both are the same";
}

}  // namespace
}  // namespace carom
