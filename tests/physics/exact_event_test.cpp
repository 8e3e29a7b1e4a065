// The effect of single events of the exact method on a disk: the TC model's elastic contacts and hops, what is counted
// as inaccurate or as a loss of energy, and the least rebound of disks that would stick together with e = 0.
#include "core/physics/exact_event.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "core/disks/obstacle_cells.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/tc_rules.hpp"

namespace carom {
namespace {

using test::contact_time;
using test::disk_at;
using test::tc_rules;

// Luding and McNamara 1998: a contact is elastic if either disk collided less than contact_time ago, not if that was
// contact_time ago or earlier.
TEST(TcPair, IsElasticWhereEitherDiskCollidedShortlyBefore) {
  const ExactRules rules = tc_rules();
  const double s = 1.0;
  for (const auto& [ago1, ago2, elastic] : {std::tuple{0.25, 7.0, true}, std::tuple{7.0, 0.25, true},
                                            std::tuple{0.25, 0.25, true}, std::tuple{0.5, 0.75, false}}) {
    ExactDisk a = disk_at(3.0, 5.0, 1.0, 0.0, s - ago1);
    ExactDisk b = disk_at(7.0, 5.0, -1.0, 0.0, s - ago2);
    b.id = 1;
    const PairImpact impact = collide_at(rules, s, a, b);
    EXPECT_TRUE(impact.happened);
    EXPECT_EQ(b.path.vx - a.path.vx, elastic ? 2.0 : 1.0);
    EXPECT_EQ(impact.inaccurate, elastic);
    EXPECT_EQ(impact.lost_energy, !elastic);
    EXPECT_EQ(a.last_contact, s);
    EXPECT_EQ(b.last_contact, s);
  }
}

// Contacts of elastic disks are elastic anyway: none is counted as inaccurate.
TEST(TcPair, ElasticDisksAreNotHeld) {
  ExactRules rules = tc_rules();
  rules.restitution = 1.0;
  ExactDisk a = disk_at(4.0, 5.0, 1.0, 0.0, 0.0);
  ExactDisk b = disk_at(6.0, 5.0, -1.0, 0.0, 0.0);
  const PairImpact impact = collide_at(rules, 0.0, a, b);
  EXPECT_TRUE(impact.happened);
  EXPECT_FALSE(impact.inaccurate);
  EXPECT_FALSE(impact.lost_energy);
}

// Rough disks with e = 1 lose energy only along their surfaces. If the TC model makes the contact elastic they are
// smooth, which is inaccurate; otherwise friction acts.
TEST(TcPair, RoughDisksAreSmoothWhereItHoldsThem) {
  const Surfaces surfaces{0.5, {0.5, 0.1}, {}};
  for (const bool held : {true, false}) {
    ExactRules rules = tc_rules();
    rules.restitution = 1.0;
    rules.surfaces = &surfaces;
    ExactDisk a = disk_at(4.0, 5.0, 1.0, 0.0, held ? 0.0 : -never);
    ExactDisk b = disk_at(6.0, 5.0, -1.0, 0.0);
    a.spin = 3.0;
    const PairImpact impact = collide_at(rules, 0.0, a, b);
    EXPECT_EQ(a.spin == 3.0, held);
    EXPECT_EQ(impact.inaccurate, held);
    EXPECT_EQ(impact.lost_energy, !held);
  }
}

// With e = 0, given as a number or by a law, there is a least rebound; without it the disks would meet again at the
// same moment for ever.
TEST(LeastRebound, OfDisksThatStick) {
  RestitutionLaw law;
  law.viscosity = 2.0;  // e(1) would be negative without the least value
  for (const RestitutionLaw* of :
       {static_cast<const RestitutionLaw*>(nullptr), static_cast<const RestitutionLaw*>(&law)}) {
    ExactRules rules = tc_rules();
    rules.restitution = of == nullptr ? least_rebound : 0.0;
    rules.law = of;
    ExactDisk a = disk_at(4.0, 5.0, 1.0, 0.0);
    ExactDisk b = disk_at(6.0, 5.0, -1.0, 0.0);
    collide_at(rules, 0.0, a, b);
    EXPECT_EQ(b.path.vx - a.path.vx, 2.0 * least_rebound);
  }
}

// A disk at rest on the floor leaves it with a quarter of g contact_time. It does not hop from walls to which gravity
// does not press it, and a disk that leaves faster by itself is not slowed.
TEST(TcHop, OffTheFloor) {
  ExactRules rules = tc_rules();
  rules.gravity = 0.8;
  ExactDisk rests = disk_at(5.0, 1.0, 0.3, 0.0);
  const WallImpact impact = meet_side_at(rules, 0.0, Side::bottom, rests);
  EXPECT_DOUBLE_EQ(rests.path.vy, 0.25 * 0.8 * contact_time);
  EXPECT_EQ(rests.path.vx, 0.3);
  EXPECT_DOUBLE_EQ(impact.impulse, 2.0 * 0.25 * 0.8 * contact_time);
  EXPECT_EQ(rests.last_contact, 0.0);
  ExactDisk fast = disk_at(5.0, 1.0, 0.0, -4.0);
  EXPECT_DOUBLE_EQ(meet_side_at(rules, 0.0, Side::bottom, fast).impulse, 2.0 * 6.0);
  EXPECT_EQ(fast.path.vy, 2.0);
  ExactDisk at_ceiling = disk_at(5.0, 9.0, 0.0, 0.0);
  EXPECT_EQ(meet_side_at(rules, 0.0, Side::top, at_ceiling).impulse, 0.0);
  EXPECT_EQ(at_ceiling.path.vy, 0.0);
}

// An impact on a wall is either made elastic by the TC model, and then inaccurate, or it loses energy.
TEST(TcWall, IsElasticShortlyAfterAContact) {
  const ExactRules rules = tc_rules();
  for (const bool held : {true, false}) {
    ExactDisk a = disk_at(9.0, 5.0, 2.0, 0.0, held ? 0.75 : 0.25);
    a.path.start = 1.0;
    const WallImpact impact = meet_side_at(rules, 1.0, Side::right, a);
    EXPECT_EQ(a.path.vx, held ? -2.0 : -1.0);
    EXPECT_EQ(impact.inaccurate, held);
    EXPECT_EQ(impact.lost_energy, !held);
    EXPECT_EQ(a.last_contact, 1.0);
  }
}

// If the TC model makes its impact on a rough wall elastic, a disk keeps its spin.
TEST(TcWall, IsSmoothWhereItHoldsADisk) {
  const Surfaces surfaces{0.5, {}, {0.5, 0.1}};
  for (const bool moving : {false, true}) {
    for (const bool held : {true, false}) {
      ExactRules rules = tc_rules();
      rules.surfaces = &surfaces;
      rules.box.restitutions.fill(1.0);
      if (moving) {
        rules.box.motions[1] = {SideMotion::Kind::steady, 0.0, 0.5};
        rules.box.move_walls(0.0);
      }
      ExactDisk a = disk_at(9.0, 5.0, 2.0, 0.0, held ? 0.0 : -never);
      a.spin = 3.0;
      const WallImpact impact = meet_side_at(rules, 0.0, Side::right, a);
      EXPECT_EQ(a.path.vx, moving ? -3.0 : -2.0);
      EXPECT_EQ(a.spin == 3.0, held) << moving;
      EXPECT_EQ(impact.inaccurate, held) << moving;
      EXPECT_EQ(impact.lost_energy, !held) << moving;
    }
  }
}

// A floor with upward acceleration a presses a disk that lies on it with g + a, so the hop is higher by as much; the
// floor's work is its speed times the impulse.
TEST(TcHop, OffAFloorThatAccelerates) {
  ExactRules rules = tc_rules();
  rules.gravity = 0.8;
  rules.box.motions[2] = {SideMotion::Kind::parabolas, 1.0, -0.25, -0.25, 4.0};
  rules.box.move_walls(0.5);
  const SidePlace floor = rules.box.place(Side::bottom);
  ASSERT_EQ(floor.acceleration, 0.5);
  ExactDisk rests = disk_at(5.0, 1.0 + floor.inset, 0.0, floor.speed);
  const WallImpact impact = meet_side_at(rules, 0.0, Side::bottom, rests);
  const double hop = 0.25 * (0.8 + 0.5) * contact_time;
  EXPECT_DOUBLE_EQ(rests.path.vy, floor.speed + hop);
  EXPECT_DOUBLE_EQ(impact.impulse, 2.0 * hop);
  EXPECT_DOUBLE_EQ(impact.energy, 2.0 * hop * floor.speed);
  // The floor accelerates only for half a period, 2; a longer contact_time does not raise the hop further.
  rules.contact_time = 100.0;
  ExactDisk at_rest = disk_at(5.0, 1.0 + floor.inset, 0.0, floor.speed);
  meet_side_at(rules, 0.0, Side::bottom, at_rest);
  EXPECT_DOUBLE_EQ(at_rest.path.vy, floor.speed + 0.25 * (0.8 * 100.0 + 0.5 * 2.0));
  // A disk is not sent after a floor that moves away faster than disks fall.
  rules.gravity = 0.2;
  rules.box.move_walls(2.5);
  ASSERT_EQ(rules.box.place(Side::bottom).acceleration, -0.5);
  ExactDisk left_behind = disk_at(5.0, 1.0, 0.0, rules.box.place(Side::bottom).speed);
  EXPECT_EQ(meet_side_at(rules, 0.0, Side::bottom, left_behind).impulse, 0.0);
}

// Energy may be lost for several reasons, each of which is enough.
TEST(Dissipation, IsThatOfDisksLawsWallsSurfacesAndObstacles) {
  ExactRules rules;
  rules.box = test::box_of(10.0, 10.0);
  EXPECT_FALSE(dissipates(rules));
  ExactRules disks = rules;
  disks.restitution = 0.9;
  EXPECT_TRUE(dissipates(disks));
  ExactRules walls = rules;
  walls.box.restitutions[3] = 0.9;
  EXPECT_TRUE(dissipates(walls));
  const Surfaces surfaces{0.5, {}, {0.5, 0.1}};
  ExactRules rough = rules;
  rough.surfaces = &surfaces;
  EXPECT_TRUE(dissipates(rough));
  RestitutionLaw law;
  law.pairs = {{0, 1, {0.9, 0.0}}};
  ExactRules pairs = rules;
  pairs.law = &law;
  EXPECT_TRUE(dissipates(pairs));
  const ObstacleCells cells({{5.0, 5.0, 0.0, 0.0, 1.0, 0.9}}, {}, rules.box);
  ExactRules pegs = rules;
  pegs.box.obstacles = &cells;
  EXPECT_TRUE(dissipates(pegs));
}

// A thermal side draws the spin if the walls are rough; if they are smooth, rough disks keep their spin.
TEST(ThermalSide, DrawsTheSpinWhereWallsAreRough) {
  for (const bool rough : {true, false}) {
    const Surfaces surfaces{0.5, {0.5, HUGE_VAL}, rough ? Roughness{0.5, HUGE_VAL} : Roughness{}};
    ExactRules rules;
    rules.box = test::box_of(10.0, 10.0);
    rules.box.temperatures.fill(3.0);
    rules.surfaces = &surfaces;
    ExactDisk a = disk_at(1.0, 5.0, -1.0, 0.0);
    a.spin = 7.0;
    EXPECT_TRUE(meet_side_at(rules, 0.0, Side::left, a).happened);
    EXPECT_EQ(a.spin != 7.0, rough);
  }
}

// In the TC model a contact with a thermal side, or with a moving one, counts as any other.
TEST(TcWall, CountsContactsWithThermalSidesAndThoseThatMove) {
  ExactRules rules = tc_rules();
  rules.box.temperatures[0] = 3.0;
  rules.box.motions[1].kind = SideMotion::Kind::steady;
  rules.box.places[1] = {0.0, 0.25, 0.0};
  for (const Side side : {Side::left, Side::right}) {
    const bool left = side == Side::left;
    ExactDisk a = disk_at(left ? 1.0 : 9.0, 5.0, left ? -1.0 : 1.0, 0.0);
    EXPECT_TRUE(meet_side_at(rules, 0.0, side, a).happened);
    EXPECT_EQ(a.last_contact, 0.0);
  }
}

// A disk that moves away from a moving side faster than its hop is left alone; and there is no friction in a hop.
TEST(TcHop, OffASideThatADiskLeavesIsNone) {
  ExactRules rules = tc_rules();
  rules.gravity = 0.8;
  const Surfaces surfaces{0.5, {0.5, HUGE_VAL}, {0.5, HUGE_VAL}};
  rules.surfaces = &surfaces;
  rules.box.motions[2].kind = SideMotion::Kind::steady;
  rules.box.places[2] = {0.0, 0.25, 0.0};
  const double hop = 0.25 * 0.8 * contact_time;
  for (const double away : {2.0 * hop, 0.5 * hop}) {
    ExactDisk a = disk_at(5.0, 1.0, 1.0, 0.25 + away);
    a.spin = 3.0;
    const WallImpact impact = meet_side_at(rules, 0.0, Side::bottom, a);
    EXPECT_DOUBLE_EQ(a.path.vy, 0.25 + std::max(away, hop));
    EXPECT_EQ(a.path.vx, 1.0);
    EXPECT_EQ(a.spin, 3.0);
    EXPECT_NEAR(impact.impulse, 2.0 * (std::max(away, hop) - away), 1e-15);
  }
}

// Across the top of a sheared box the second disk collides as its image, whose velocity differs by the jump. A disk
// that is out of the box is put back into it, and the change of energy is the work of the shear.
TEST(CollideSheared, AcrossTheTopGivesTheWorkOfTheShear) {
  ExactRules rules;
  rules.box = test::box_of(20.0, 10.0, test::Periodic::both);
  rules.box.shear = {0.4, 4.0, 3.0};
  rules.common_mass = false;
  const double s = 0.25;
  const double offset = 3.0 + 4.0 * s;
  for (const bool first_crosses : {true, false}) {
    // At time s the first disk is at (5, y), and the second one's image at (6.2, y + 1.6).
    const double y = first_crosses ? 10.05 : 8.35;
    ExactDisk a = disk_at(5.0 - 0.5 * s, y - s, 0.5, 1.0);
    ExactDisk b = disk_at(6.2 - offset + 5.0 * s, y + 1.6 - 10.0 + s, -5.0, -1.0);
    b.id = 1;
    b.mass = 3.0;
    const auto energy = [&] {
      return 0.5 * 2.0 * (a.path.vx * a.path.vx + a.path.vy * a.path.vy) +
             0.5 * 3.0 * (b.path.vx * b.path.vx + b.path.vy * b.path.vy);
    };
    const double before = energy();
    const PairImpact impact = collide_at(rules, s, a, b);
    EXPECT_TRUE(impact.happened);
    EXPECT_NEAR(a.path.x, first_crosses ? 5.0 - offset : 5.0, 1e-13);
    EXPECT_NEAR(a.path.y, first_crosses ? 0.05 : 8.35, 1e-13);
    EXPECT_NEAR(b.path.x, first_crosses ? 6.2 - offset : 6.2, 1e-13);
    EXPECT_NEAR(b.path.y, first_crosses ? 1.65 : 9.95, 1e-13);
    EXPECT_NEAR(a.path.vy, 1.0 - 0.8 * 2.0 * 2.5 * 0.6, 1e-14);
    EXPECT_NEAR(b.path.vy, -1.0 + 0.8 * 2.0 * 2.5 * 0.4, 1e-14);
    EXPECT_NEAR(impact.shear_work, energy() - before, 1e-13);
    EXPECT_NE(impact.shear_work, 0.0);
  }
}

// An inner wall has a restitution of its own: the law of the disk with the same number does not apply to it, but it
// does to a fixed disk.
TEST(Dissipation, OfAnInnerWallIsItsOwn) {
  const RestitutionLaw law{0.0, {1, 2}, {{0, 1, {0.5, 0.0}}}};
  for (const auto kind : {ObstacleKind::wall, ObstacleKind::disk}) {
    ExactRules rules;
    rules.box = test::box_of(10.0, 10.0);
    rules.law = &law;
    const bool wall = kind == ObstacleKind::wall;
    const auto cells = place_obstacles({{5.0, 5.0, wall ? 2.0 : 0.0, 0.0, wall ? 0.0 : 1.0, 1.0, 0, kind}}, rules.box);
    EXPECT_EQ(may_lose_energy(rules, 1, obstacle_partner(0)), !wall);
  }
}

// 257 impacts that lose energy within 1e-12 of a window are a collapse; the same number within a longer time is not.
TEST(Burst, IsOfMoreThan256ImpactsInAVanishingTime) {
  const double window = 8.0;
  Burst burst;
  for (int k = 0; k < 256; ++k) EXPECT_FALSE(burst.add(1.0, window)) << k;
  EXPECT_TRUE(burst.add(1.0 + 0.9e-12 * window, window));
  Burst slower;
  for (int k = 0; k < 1024; ++k) EXPECT_FALSE(slower.add(1.0 + k * (0.01e-12 * window), window)) << k;
}

}  // namespace
}  // namespace carom
