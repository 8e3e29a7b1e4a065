// Obstacles in the TC model: elastic contacts, hops, friction, and moving obstacles.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/physics/exact_event.hpp"
#include "tests/support/tc_rules.hpp"

namespace carom {
namespace {

using test::contact_time;
using test::disk_at;
using test::tc_rules;

// The rules of a box with one obstacle.
class TcObstacle : public ::testing::Test {
 protected:
  // Makes this the obstacle of rules.box.
  void place(const Obstacle& o, const WallMotion& motion = {}) {
    std::vector<WallMotion> motions;
    if (o.moves) motions.push_back(motion);
    rules.box.inner_walls_move = o.moves;
    cells_ = std::make_unique<ObstacleCells>(std::vector<Obstacle>{o}, motions, rules.box);
    rules.box.obstacles = cells_.get();
  }

  ExactRules rules = tc_rules();
  const Obstacle peg{5.0, 5.0, 0.0, 0.0, 2.0, 0.5, 9, ObstacleKind::disk};
  const Obstacle slope{1.0, 2.0, 8.0, 6.0, 0.0, 0.5, 0, ObstacleKind::wall};

 private:
  std::unique_ptr<ObstacleCells> cells_;
};

// The hop is given by the component of gravity that presses the disk to the obstacle, a fixed disk or a slope: n = (-3,
// 4) / 5.
TEST_F(TcObstacle, IsLeftWithAHop) {
  rules.gravity = 0.8;
  const double hop = 0.25 * 0.8 * 0.8 * contact_time;
  place(peg);
  ExactDisk on_peg = disk_at(5.0 - 1.8, 5.0 + 2.4, 0.0, 0.0);
  WallImpact impact = meet_obstacle_at(rules, 0.0, 0, on_peg);
  EXPECT_NEAR(on_peg.path.vx, -0.6 * hop, 1e-15);
  EXPECT_NEAR(on_peg.path.vy, 0.8 * hop, 1e-15);
  EXPECT_NEAR(impact.impulse, 2.0 * hop, 1e-15);
  EXPECT_EQ(on_peg.last_contact, 0.0);
  place(slope);
  ExactDisk on_slope = disk_at(5.0 - 0.6, 5.0 + 0.8, 0.4, 0.3);
  impact = meet_obstacle_at(rules, 0.0, 0, on_slope);
  EXPECT_NEAR(on_slope.path.vx, 0.4 - 0.6 * hop, 1e-15);
  EXPECT_NEAR(on_slope.path.vy, 0.3 + 0.8 * hop, 1e-15);
  EXPECT_NEAR(impact.impulse, 2.0 * hop, 1e-15);
}

// A disk that comes in slowly leaves with the speed of the hop alone, not with that of its rebound and the hop.
TEST_F(TcObstacle, IsLeftWithTheHopWhateverTheApproach) {
  rules.gravity = 0.8;
  place({1.0, 5.0, 8.0, 0.0, 0.0, 0.5, 0, ObstacleKind::wall});
  ExactDisk slow = disk_at(5.0, 6.0, 0.0, -0.01);
  EXPECT_NEAR(meet_obstacle_at(rules, 0.0, 0, slow).impulse, 2.0 * (0.01 + 0.1), 1e-15);
  EXPECT_NEAR(slow.path.vy, 0.25 * 0.8 * contact_time, 1e-15);
  ExactDisk fast = disk_at(5.0, 6.0, 0.0, -4.0);
  meet_obstacle_at(rules, 0.0, 0, fast);
  EXPECT_NEAR(fast.path.vy, 2.0, 1e-15);
}

TEST_F(TcObstacle, IsElasticShortlyAfterAContact) {
  place(peg);
  for (const bool held : {true, false}) {
    ExactDisk a = disk_at(5.0, 8.0, 0.0, -2.0, held ? -0.25 : -0.5);
    const WallImpact impact = meet_obstacle_at(rules, 0.0, 0, a);
    EXPECT_NEAR(a.path.vy, held ? 2.0 : 1.0, 1e-15);
    EXPECT_EQ(impact.inaccurate, held);
    EXPECT_EQ(impact.lost_energy, !held);
    EXPECT_EQ(a.last_contact, 0.0);
  }
  // A disk that only passes by makes no contact.
  ExactDisk passes = disk_at(5.0, 8.0, 1.0, 0.0);
  const WallImpact impact = meet_obstacle_at(rules, 0.0, 0, passes);
  EXPECT_FALSE(impact.happened);
  EXPECT_FALSE(impact.lost_energy);
  EXPECT_EQ(passes.last_contact, -never);
}

// Rough disks with e = 1 lose energy only along their surfaces, and not at all if the TC model makes the contact
// elastic.
TEST_F(TcObstacle, IsSmoothWhereItHoldsADisk) {
  const Surfaces surfaces{0.5, {0.5, 0.1}, {0.5, 0.1}};
  rules.surfaces = &surfaces;
  Obstacle elastic = peg;
  elastic.restitution = 1.0;
  place(elastic);
  for (const bool held : {true, false}) {
    ExactDisk a = disk_at(5.0, 8.0, 0.0, -2.0, held ? 0.0 : -never);
    a.spin = 3.0;
    const WallImpact impact = meet_obstacle_at(rules, 0.0, 0, a);
    EXPECT_EQ(a.spin == 3.0, held);
    EXPECT_EQ(impact.inaccurate, held);
    EXPECT_EQ(impact.lost_energy, !held);
  }
}

// e = 1 - a v^(1/5), where v is the speed of approach; it does not depend on the size of the fixed disk.
TEST_F(TcObstacle, HasTheRestitutionOfTheSpeedOfApproach) {
  RestitutionLaw law;
  law.viscosity = 0.25;
  rules.restitution = 0.0;
  rules.law = &law;
  place(peg);
  ExactDisk a = disk_at(5.0, 8.0, 0.0, -32.0);
  meet_obstacle_at(rules, 0.0, 0, a);
  EXPECT_NEAR(a.path.vy, 0.5 * 32.0, 1e-12);  // 32^(1/5) = 2
}

TEST_F(TcObstacle, HasALeastRebound) {
  rules.constant = true;
  rules.contact_time = -1.0;
  Obstacle sticks = peg;
  sticks.restitution = 0.0;
  place(sticks);
  ExactDisk a = disk_at(5.0, 8.0, 0.0, -2.0);
  meet_obstacle_at(rules, 0.0, 0, a);
  EXPECT_NEAR(a.path.vy, 2.0 * least_rebound, 1e-27);
}

// An inner wall with an upward acceleration a, in the first quarter of a vibration: in its frame g + a presses disks to
// it.
TEST_F(TcObstacle, ThatAcceleratesIsLeftWithAHigherHop) {
  rules.gravity = {0.3, 0.8};
  WallMotion motion;
  motion.pace = {SideMotion::Kind::parabolas, 0.0, 0.0, 1.0, 4.0};
  motion.along = {-0.15, -0.2};  // downwards at first, and ever slower
  Obstacle wall = slope;
  wall.moves = true;
  // The normal n = (-3, 4) / 5 is oblique to gravity and to the wall's acceleration, so that components along both axes
  // count.
  place(wall, motion);
  rules.box.move_walls(0.5);
  const WallPlace now = motion.at(rules.box.clock);
  const double gn = (0.3 * -0.6 + 0.8 * 0.8) + (now.acceleration.x * -0.6 + now.acceleration.y * 0.8);
  ASSERT_NE(now.acceleration.x, 0.0);
  const double hop = 0.25 * gn * contact_time;
  ASSERT_GT(hop, 0.0);
  ExactDisk a = disk_at(5.0 - 0.6 + now.shift.x, 5.0 + 0.8 + now.shift.y, now.velocity.x, now.velocity.y);
  const WallImpact impact = meet_obstacle_at(rules, 0.0, 0, a);
  EXPECT_NEAR(a.path.vx, now.velocity.x - 0.6 * hop, 1e-14);
  EXPECT_NEAR(a.path.vy, now.velocity.y + 0.8 * hop, 1e-14);
  EXPECT_NEAR(impact.energy, 2.0 * hop * (-0.6 * now.velocity.x + 0.8 * now.velocity.y), 1e-14);
  EXPECT_NEAR(impact.impulse, 2.0 * hop, 1e-14);
  EXPECT_NEAR(impact.momentum.x, -0.6 * 2.0 * hop, 1e-14);
  EXPECT_NEAR(impact.momentum.y, 0.8 * 2.0 * hop, 1e-14);
  // The wall accelerates for half a period, 2, so a longer contact_time does not raise this part of the hop.
  rules.contact_time = 100.0;
  const double longer =
      0.25 * ((0.3 * -0.6 + 0.8 * 0.8) * 100.0 + (now.acceleration.x * -0.6 + now.acceleration.y * 0.8) * 2.0);
  ExactDisk b = disk_at(5.0 - 0.6 + now.shift.x, 5.0 + 0.8 + now.shift.y, now.velocity.x, now.velocity.y);
  meet_obstacle_at(rules, 0.0, 0, b);
  EXPECT_NEAR(b.path.vy, now.velocity.y + 0.8 * longer, 1e-12);
}

// A disk that hits a fixed disk is subject to friction, by the change of its normal speed, whatever the distance of the
// centres; one that only hops is not.
TEST_F(TcObstacle, RubsWhatItHits) {
  const Surfaces surfaces{0.5, {0.5, 0.1}, {0.5, 0.1}};
  rules.surfaces = &surfaces;
  rules.gravity = 0.8;
  place(peg);
  ExactDisk hits = disk_at(5.0, 8.0, 3.0, -2.0);
  meet_obstacle_at(rules, 0.0, 0, hits);
  EXPECT_NEAR(hits.path.vx, 3.0 - 0.1 * 3.0, 1e-14);
  ExactDisk hops = disk_at(5.0, 8.0, 3.0, 0.0);
  meet_obstacle_at(rules, 0.0, 0, hops);
  EXPECT_EQ(hops.path.vx, 3.0);
  EXPECT_EQ(hops.spin, 0.0);
}

}  // namespace
}  // namespace carom
