// The motion of a group, compared with numbers by hand: disks of different masses, in one piece and in several.
#include "core/measure/group_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/disks_by_hand.hpp"
#include "tests/support/motion_of_group.hpp"

namespace carom {
namespace {

// Masses of 1 and 3 have velocities (5, 2) and (1, -2): the mean is (2, -1), and relative to it they are (3, 3) and
// (-1, -1).
TEST(GroupMotion, IsTheMeanVelocityAndTheTemperatureAroundIt) {
  const Disks disks = test::disks_of({{1, 2, 5, 2, 0.5, 1}, {3, 3, 100, 100, 0.5, 7}, {5, 6, 1, -2, 0.5, 3}});
  const std::vector<std::size_t> members{0, 2}, first{0}, second{2};
  const GroupMotion whole = test::group_motion(disks, members);
  GroupTally tally;
  tally.add(disks, first);
  tally.add(disks, second);
  tally.add_thermal(disks, first);
  tally.add_thermal(disks, second);
  for (const GroupMotion& motion : {whole, tally.motion()}) {
    EXPECT_EQ(motion.disks, 2U);
    EXPECT_DOUBLE_EQ(motion.velocity.x, 2.0);
    EXPECT_DOUBLE_EQ(motion.velocity.y, -1.0);
    EXPECT_DOUBLE_EQ(motion.centre.x, (1.0 + 3.0 * 5.0) / 4.0);
    EXPECT_DOUBLE_EQ(motion.centre.y, (2.0 + 3.0 * 6.0) / 4.0);
    EXPECT_DOUBLE_EQ(motion.kinetic, 0.5 * (29.0 + 3.0 * 5.0));
    EXPECT_DOUBLE_EQ(motion.temperature, 0.5 * (18.0 + 3.0 * 2.0) / 2.0);
  }
}

TEST(GroupMotion, OfNoDisksIsNone) {
  const GroupMotion motion = test::group_motion(Disks{}, {});
  EXPECT_EQ(motion.disks, 0U);
  EXPECT_EQ(motion.kinetic, 0.0);
  EXPECT_TRUE(std::isnan(motion.centre.x) && std::isnan(motion.centre.y));
  EXPECT_TRUE(std::isnan(motion.temperature) && std::isnan(motion.velocity.x) && std::isnan(motion.velocity.y));
}

}  // namespace
}  // namespace carom
