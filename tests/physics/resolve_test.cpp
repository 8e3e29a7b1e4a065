// What a step does with one contact, by hand: one that began within the step, one that is older, and one whose disk
// gravity holds back.
#include "core/physics/resolve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/disks/obstacle_cells.hpp"
#include "core/step/rollback_frame.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr double dt = 0.125;

StepRules rules_of(const Gravity& gravity, double restitution) {
  StepRules rules{test::box_of(20.0, 10.0), gravity, restitution, dt, false};
  rules.box.restitutions.fill(restitution);
  return rules;
}

template <class OfKind>
OfKind resolve(Disks& disks, const StepRules& rules, const ContactEvent& e) {
  return with_view(disks, rules, [&](const auto& d) { return std::get<OfKind>(resolve_event(d, rules, e)); });
}

// Disks 0 and 1.
PairImpact resolve_disks(Disks& disks, const StepRules& rules) {
  return resolve<PairImpact>(disks, rules, {0.0, 0, 1, 0, 1});
}

WallImpact resolve_disk_at(Disks& disks, const StepRules& rules, DiskId wall) {
  return resolve<WallImpact>(disks, rules, {0.0, 0, wall, 0, 0});
}

// A contact that began with the step, but for a millionth of it, began within it, and is ordered as if with it.
TEST(ContactTime, IsOfTheStepButForAMillionth) {
  EXPECT_TRUE(began_within(dt * (1.0 + 0.9e-6), dt));
  EXPECT_FALSE(began_within(dt * (1.0 + 1.1e-6), dt));
  EXPECT_EQ(time_within(dt * (1.0 - 0.9e-6), dt), dt);
  EXPECT_EQ(time_within(dt * (1.0 - 1.1e-6), dt), dt * (1.0 - 1.1e-6));
  EXPECT_EQ(time_within(2.0 * dt, dt), dt);
}

// Late is what lay beyond a wall when the step began, by more than a hundredth of its way in the step; not what gravity
// holds there.
TEST(ContactTime, IsLateWhereADiskWasBeyondBefore) {
  const double way = 2.0 * dt;
  EXPECT_TRUE(is_met_late(1.02 * dt, 1.02 * way, 2.0, dt));
  EXPECT_FALSE(is_met_late(1.005 * dt, 1.005 * way, 2.0, dt));
  EXPECT_FALSE(is_met_late(0.9 * dt, 1.02 * way, 2.0, dt));
  EXPECT_FALSE(is_met_late(HUGE_VAL, 0.9 * way, 2.0, dt));
}

// A pair whose contact is older than the step collides where it is, and late.
TEST(ResolvePair, ThatIsOlderThanTheStepCollidesWhereItIs) {
  for (const double overlap : {0.2, 0.3}) {  // at relative speed 2: 0.1 and 0.15 ago
    Disks disks = test::disks_of({{5.0, 5.0, 1.0, 0.0, 1.0, 1.0}, {7.0 - overlap, 5.0, -1.0, 0.0, 1.0, 3.0}});
    const PairImpact impact = resolve_disks(disks, rules_of(0.0, 1.0));
    const bool late = overlap > 0.25;
    EXPECT_TRUE(impact.happened);
    EXPECT_EQ(impact.inaccurate, late);
    EXPECT_NEAR(disks.vx[0], -2.0, 1e-15);
    EXPECT_NEAR(disks.vx[1], 0.0, 1e-15);
    EXPECT_NEAR(disks.x[0], late ? 5.0 : 5.0 - 0.1 * 1.0 - 0.1 * 2.0, 1e-14);
  }
}

// Only what touches and approaches collides.
TEST(ResolvePair, LeavesOthersAlone) {
  for (const auto& [apart, speed] : {std::pair{2.1, -1.0}, std::pair{1.9, 1.0}}) {
    Disks disks = test::disks_of({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {5.0 + apart, 5.0, speed, 0.0, 1.0, 3.0}});
    EXPECT_FALSE(resolve_disks(disks, rules_of(0.0, 1.0)).happened);
    EXPECT_EQ(disks.vx[0], 0.0);
    EXPECT_EQ(disks.x[0], 5.0);
  }
}

// A disk that has been pressed 0.1 into the floor, a fixed disk or a slope, and so long ago, comes back to it with what
// lifting it costs taken from its motion: v'^2 = v^2 - 2 g_n 0.1. Where that is more than there is, it rests.
TEST(ResolveWall, LiftsADiskAtTheCostOfItsMotion) {
  for (const int kind : {0, 1, 2}) {
    for (const double speed : {0.7, 0.3}) {
      StepRules rules = rules_of(2.0, 0.5);
      const Obstacle peg{10.0, 5.0, 0.0, 0.0, 2.0, 0.5, 0, ObstacleKind::disk};
      const Obstacle slope{7.0, 3.0, 4.0, 3.0, 0.0, 0.5, 0, ObstacleKind::wall};
      const ObstacleCells cells({kind == 2 ? slope : peg}, {}, rules.box);
      if (kind > 0) rules.box.obstacles = &cells;
      const Vec2 n = kind == 0 ? Vec2{0.0, 1.0} : Vec2{-0.6, 0.8};
      const Vec2 touching = kind == 0   ? Vec2{3.0, 1.0}
                            : kind == 1 ? Vec2{10.0 + 3.0 * n.x, 5.0 + 3.0 * n.y}
                                        : Vec2{9.0 + n.x, 4.5 + n.y};
      Disks disks =
          test::disks_of({{touching.x - 0.1 * n.x, touching.y - 0.1 * n.y, -speed * n.x, -speed * n.y, 1.0, 3.0}});
      const WallImpact impact =
          resolve_disk_at(disks, rules, kind == 0 ? wall_partner(Side::bottom) : obstacle_partner(0));
      const double left = speed * speed - 2.0 * 2.0 * n.y * 0.1;
      const double away = 0.5 * std::sqrt(std::max(0.0, left));
      EXPECT_NEAR(disks.vx[0], away * n.x, 1e-14) << kind;
      EXPECT_NEAR(disks.vy[0], away * n.y, 1e-14) << kind;
      EXPECT_NEAR(disks.x[0], touching.x, 1e-14) << kind;
      EXPECT_NEAR(disks.y[0], touching.y, 1e-14) << kind;
      EXPECT_NEAR(impact.impulse, 3.0 * (speed + away), 1e-14) << kind;
    }
  }
}

// A restitution that depends on speed is that of the speed with which it gets there: e = 1 - 0.5 v^(1/5).
TEST(ResolveWall, AsksForTheRestitutionOfTheSpeedAtTheObstacle) {
  RestitutionLaw law;
  law.viscosity = 0.5;
  StepRules rules = rules_of(2.0, 0.0);
  rules.law = &law;
  const ObstacleCells cells({{10.0, 5.0, 0.0, 0.0, 2.0, 0.0, 7, ObstacleKind::disk}}, {}, rules.box);
  rules.box.obstacles = &cells;
  Disks disks = test::disks_of({{10.0, 7.9, 0.0, -0.7, 1.0, 3.0}});
  resolve_disk_at(disks, rules, obstacle_partner(0));
  const double there = std::sqrt(0.49 - 0.4);
  EXPECT_NEAR(disks.vy[0], there * (1.0 - 0.5 * std::pow(there, 0.2)), 1e-14);
}

// In a sheared box the stress is the virial along x and y: the momentum along x that goes along y. Across the top the
// image has so much more energy than the disk: the jump times the momentum, which the shear does not give.
TEST(SeeShear, CountsMomentumThatGoesAlongY) {
  const Relative r{0.6, 0.8, -1.0, -2.0};
  Shear shear;
  shear.rate = 0.5;
  shear.jump = 5.0;
  for (const int rows : {-1, 0, 1}) {
    PairImpact smooth;
    smooth.virial = 4.0;
    see_shear(smooth, r, rows, 2.4, false, shear);
    EXPECT_TRUE(smooth.sheared);
    EXPECT_DOUBLE_EQ(smooth.shear_virial, 4.0 * 0.48);
    EXPECT_DOUBLE_EQ(smooth.shear_work, -5.0 * rows * 2.4);
    PairImpact rough;
    rough.virial = 4.0;
    see_shear(rough, r, rows, 3.0, true, shear);
    EXPECT_DOUBLE_EQ(rough.shear_virial, 0.8 * 3.0);
  }
}

// A frame of rollback leaves no disk in a wall or in something fixed, though it moves away and nothing collides.
TEST(MeetWalls, PushesADiskThatMovesAway) {
  StepRules rules = rules_of(0.0, 1.0);
  const ObstacleCells cells({{10.0, 5.0, 0.0, 0.0, 2.0, 1.0}}, {}, rules.box);
  rules.box.obstacles = &cells;
  Disks disks = test::disks_of(
      {{0.9, 5.0, 1.0, 0.0, 1.0, 1.0}, {6.0, 9.2, 0.0, -1.0, 1.0, 1.0}, {10.0, 7.8, 0.0, 1.0, 1.0, 1.0}});
  ImpactTally tally;
  Overlap seen;
  for (std::uint32_t i = 0; i < 3; ++i) {
    with_view(disks, [&](const auto& d) { meet_walls(d, rules, i, tally, seen); });
  }
  EXPECT_EQ(tally.wall_collisions, 0U);
  EXPECT_EQ(disks.x[0], 1.0);
  EXPECT_EQ(disks.y[1], 9.0);
  EXPECT_EQ(disks.y[2], 8.0);
  EXPECT_EQ(seen.size, 0.0);
}

// A pair bounces at a distance (F2) where all go back further than to its contact; by a billionth of the frame is
// rounding.
TEST(Rollback, TellsAPairThatBouncesAtADistance) {
  const StepRules rules = rules_of(0.0, 1.0);
  const ContactEvent e{0.0625, 0, 1, 0, 1};
  EXPECT_FALSE(is_at_a_distance(rules, e, 0.0625));
  EXPECT_FALSE(is_at_a_distance(rules, e, 0.0625 + 0.9e-9 * dt));
  EXPECT_TRUE(is_at_a_distance(rules, e, 0.0625 + 1.1e-9 * dt));
}

}  // namespace
}  // namespace carom
