// The handling of one contact in a step: a contact that began within the step, an older one, and one to which gravity
// holds the disk.
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

// A contact that began at the start of the step, within a millionth of the step, counts as begun within the step, and
// is ordered as if it began exactly then.
TEST(ContactTime, IsOfTheStepButForAMillionth) {
  EXPECT_TRUE(began_within(dt * (1.0 + 0.9e-6), dt));
  EXPECT_FALSE(began_within(dt * (1.0 + 1.1e-6), dt));
  EXPECT_EQ(time_within(dt * (1.0 - 0.9e-6), dt), dt);
  EXPECT_EQ(time_within(dt * (1.0 - 1.1e-6), dt), dt * (1.0 - 1.1e-6));
  EXPECT_EQ(time_within(2.0 * dt, dt), dt);
}

// A contact is late if the disk was beyond the wall when the step began, by more than a hundredth of its way in the
// step; not if gravity holds the disk there.
TEST(ContactTime, IsLateWhereADiskWasBeyondBefore) {
  const double way = 2.0 * dt;
  EXPECT_TRUE(is_met_late(1.02 * dt, 1.02 * way, 2.0, dt));
  EXPECT_FALSE(is_met_late(1.005 * dt, 1.005 * way, 2.0, dt));
  EXPECT_FALSE(is_met_late(0.9 * dt, 1.02 * way, 2.0, dt));
  EXPECT_FALSE(is_met_late(HUGE_VAL, 0.9 * way, 2.0, dt));
}

// Contacts are handled in the order in which they began, computed from the present path in the frame of a moving
// obstacle.
TEST(ContactTime, IsInTheFrameOfWhatMoves) {
  StepRules rules = rules_of(2.0, 0.5);
  rules.box.places[0] = {1.0, 0.5, 0.0};
  const ObstacleCells cells({{7.0, 3.0, 4.0, 3.0, 0.0, 0.5, 0, ObstacleKind::wall}}, {}, rules.box);
  rules.box.obstacles = &cells;
  Disks disks = test::disks_of({{5.0, 5.0, -2.0, -2.0, 1.0, 1.0}, {6.4, 5.0, -4.0, -2.0, 0.5, 1.0}});
  with_view(disks, [&](const auto& d) {
    EXPECT_NEAR(pair_event(d, rules, 0, 1).ago, 0.1 / 2.0, 1e-15);
    EXPECT_DOUBLE_EQ(wall_event(d, rules, 0, Side::left, 0.1).ago, 0.1 / 2.5);
    EXPECT_DOUBLE_EQ(wall_event(d, rules, 0, Side::bottom, 0.1).ago, 0.2 / (2.0 + std::sqrt(3.6)));
    const ObstacleGap beside{1.0, 0.0, 0.1, true, {}, {0.5, 0.0}}, above{0.0, 1.0, 0.1, true, {}, {0.0, 0.5}};
    EXPECT_DOUBLE_EQ(obstacle_event(d, rules, 0, 0, beside).ago, 0.1 / 2.5);
    EXPECT_DOUBLE_EQ(obstacle_event(d, rules, 0, 0, above).ago, 0.2 / (2.5 + std::sqrt(2.5 * 2.5 - 0.4)));
  });
}

// A pair whose contact is older than the step collides where it is, and counts as late.
TEST(ResolvePair, ThatIsOlderThanTheStepCollidesWhereItIs) {
  for (const double overlap : {0.2, 0.3}) {  // at relative speed 2: contacts 0.1 and 0.15 ago
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

// Only pairs that touch and approach collide.
TEST(ResolvePair, LeavesOthersAlone) {
  for (const auto& [apart, speed] : {std::pair{2.1, -1.0}, std::pair{1.9, 1.0}}) {
    Disks disks = test::disks_of({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {5.0 + apart, 5.0, speed, 0.0, 1.0, 3.0}});
    EXPECT_FALSE(resolve_disks(disks, rules_of(0.0, 1.0)).happened);
    EXPECT_EQ(disks.vx[0], 0.0);
    EXPECT_EQ(disks.x[0], 5.0);
  }
}

// Across the top of a sheared box the first disk collides with the second one's image, which moves with the jump while
// both go back to their contact and forward again.
TEST(ResolvePair, AcrossTheTopIsOfTheImageThatMoves) {
  StepRules sheared = rules_of(0.0, 0.5);
  test::set_sides(sheared.box, SideKind::periodic, SideKind::periodic);
  sheared.box.shear = {0.4, 4.0, 3.0};
  const Disk first{5.0, 9.5, 0.5, 1.0, 1.0, 1.0}, image{6.14, 11.02, -1.0, -1.0, 1.0, 3.0};
  Disks in_flow = test::disks_of({first, {image.x - 3.0, image.y - 10.0, image.vx - 4.0, image.vy, 1.0, 3.0}});
  Disks alone = test::disks_of({first, image});
  StepRules rules = rules_of(0.0, 0.5);
  rules.box.height = 20.0;
  const PairImpact impact = resolve_disks(in_flow, sheared);
  EXPECT_TRUE(impact.sheared);
  EXPECT_NEAR(impact.virial, resolve_disks(alone, rules).virial, 1e-14);
  const double rows[] = {0.0, 1.0};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(in_flow.x[i] + 3.0 * rows[i], alone.x[i], 1e-14) << i;
    EXPECT_NEAR(in_flow.y[i] + 10.0 * rows[i], alone.y[i], 1e-14) << i;
    EXPECT_NEAR(in_flow.vx[i] + 4.0 * rows[i], alone.vx[i], 1e-14) << i;
    EXPECT_NEAR(in_flow.vy[i], alone.vy[i], 1e-14) << i;
  }
}

// At a side that comes in at 0.5 a disk bounces in the side's frame, at the place where the side was at the contact; if
// the contact was before the step, at the side's present place. The energy gained is the side's work.
TEST(ResolveWall, OfASideThatMovesIsInItsFrame) {
  for (const double beyond : {0.1, 0.5}) {  // at 2.5 in the side's frame: contacts 0.04 and 0.2 ago
    StepRules rules = rules_of(0.0, 0.5);
    rules.box.motions[0].kind = SideMotion::Kind::steady;
    rules.box.places[0] = {1.0, 0.5, 0.0};
    Disks disks = test::disks_of({{2.0 - beyond, 5.0, -2.0, 0.75, 1.0, 3.0}});
    const WallImpact impact = resolve_disk_at(disks, rules, wall_partner(Side::left));
    const bool late = beyond > 0.3;
    EXPECT_EQ(impact.inaccurate, late);
    EXPECT_DOUBLE_EQ(disks.vx[0], 0.5 + 0.5 * 2.5);
    EXPECT_EQ(disks.vy[0], 0.75);
    EXPECT_NEAR(disks.x[0], late ? 2.0 : 2.0 + 0.5 * beyond, 1e-14);
    EXPECT_DOUBLE_EQ(impact.impulse, 3.0 * 1.5 * 2.5);
    EXPECT_DOUBLE_EQ(impact.energy, 0.5 * impact.impulse);
  }
}

// A rising floor, too, lifts a disk up to itself, and the energy for that is taken from the disk's motion.
TEST(ResolveWall, LiftsADiskToAFloorThatMoves) {
  StepRules rules = rules_of(2.0, 0.5);
  rules.box.motions[2].kind = SideMotion::Kind::steady;
  rules.box.places[2] = {1.0, 0.5, 0.0};
  Disks disks = test::disks_of({{5.0, 1.9, 0.0, -0.2, 1.0, 3.0}});
  const WallImpact impact = resolve_disk_at(disks, rules, wall_partner(Side::bottom));
  const double away = 0.5 * std::sqrt(0.7 * 0.7 - 2.0 * 2.0 * 0.1);
  EXPECT_TRUE(impact.inaccurate);
  EXPECT_DOUBLE_EQ(disks.vy[0], 0.5 + away);
  EXPECT_EQ(disks.y[0], 2.0);
  EXPECT_DOUBLE_EQ(impact.impulse, 3.0 * (0.7 + away));
}

// At a thermal side a velocity is drawn once, at the point of contact, and the disk moves on with it for the rest of
// the step. It stays at the side if its contact is older, or if gravity brings it back.
TEST(ResolveWall, OfAThermalSideIsDrawnWhereItIsTouched) {
  for (const double beyond : {0.1, 0.3}) {  // at speed 2: contacts 0.05 and 0.15 ago
    StepRules rules = rules_of(0.0, 1.0);
    rules.box.temperatures[1] = 2.0;
    std::uint32_t hits = 4;
    rules.seed = 11;
    rules.thermal_hits = &hits;
    Disks disks = test::disks_of({{19.0 + beyond, 5.0, 2.0, 0.75, 1.0, 3.0}});
    double vx = 2.0, vy = 0.75;
    const ThermalReflection drawn = reflect_thermally(Side::right, 2.0, 3.0, {11, 0, 4}, vx, vy);
    const WallImpact impact = resolve_disk_at(disks, rules, wall_partner(Side::right));
    const bool late = beyond > 0.25;
    EXPECT_EQ(impact.inaccurate, late);
    EXPECT_EQ(hits, 5U);
    EXPECT_EQ(disks.vx[0], vx);
    EXPECT_EQ(disks.vy[0], vy);
    EXPECT_NEAR(disks.x[0], late ? 19.0 : 19.0 + 0.05 * vx, 1e-14);
    EXPECT_NEAR(disks.y[0], late ? 5.0 : 5.0 + 0.05 * (vy - 0.75), 1e-14);
    EXPECT_DOUBLE_EQ(impact.impulse, 3.0 * (2.0 - vx));
    EXPECT_EQ(impact.energy, drawn.energy);
  }
  StepRules rules = rules_of(50.0, 1.0);
  rules.box.temperatures[2] = 1e-9;
  std::uint32_t hits = 0;
  rules.thermal_hits = &hits;
  Disks disks = test::disks_of({{5.0, 0.9, 0.0, -4.0, 1.0, 3.0}});
  EXPECT_FALSE(resolve_disk_at(disks, rules, wall_partner(Side::bottom)).inaccurate);
  EXPECT_EQ(disks.y[0], 1.0);
  EXPECT_LT(disks.vy[0], -1.0) << "it must have fallen since the contact";
}

// Beside smooth walls, thermal ones too, a rough disk keeps its spin.
TEST(ResolveWall, OfASmoothThermalSideLeavesTheSpin) {
  for (const bool rough : {false, true}) {
    Surfaces surfaces;
    surfaces.inertia = 0.5;
    if (rough) surfaces.walls = {0.5, 0.1};
    StepRules rules = rules_of(0.0, 1.0);
    rules.surfaces = &surfaces;
    rules.box.temperatures[1] = 2.0;
    std::uint32_t hits = 0;
    rules.thermal_hits = &hits;
    Disks disks = test::disks_of({{19.1, 5.0, 2.0, 0.75, 1.0, 3.0}});
    disks.inertia = 0.5;
    disks.spin = {7.0};
    const WallImpact impact = resolve_disk_at(disks, rules, wall_partner(Side::right));
    EXPECT_EQ(disks.spin[0] == 7.0, !rough);
    const double moving = 0.5 * 3.0 * (disks.vx[0] * disks.vx[0] + disks.vy[0] * disks.vy[0] - 4.5625);
    const double turning = 0.5 * 0.5 * 3.0 * (disks.spin[0] * disks.spin[0] - 49.0);
    EXPECT_NEAR(impact.energy, moving + turning, 1e-12);
  }
}

// For a disk that slides along a wall, friction acts by the whole change of the normal velocity, in the wall's frame:
// the disk loses a tenth of that change along the wall, whether it bounces within the step or where it is.
TEST(ResolveWall, RubsByAllThatPressesIt) {
  Surfaces surfaces;
  surfaces.inertia = 0.5;
  surfaces.walls = {0.5, 0.1};
  for (const int kind : {0, 1, 2}) {  // a side, a moving side, an inner wall
    for (const double beyond : {0.1, 0.5}) {
      StepRules rules = rules_of(0.0, 0.5);
      rules.surfaces = &surfaces;
      const ObstacleCells cells({{3.0, 0.0, 0.0, 10.0, 0.0, 0.5, 0, ObstacleKind::wall}}, {}, rules.box);
      if (kind == 1) {
        rules.box.motions[0].kind = SideMotion::Kind::steady;
        rules.box.places[0] = {1.0, 0.5, 0.0};
      }
      if (kind == 2) rules.box.obstacles = &cells;
      const double wall = kind == 0 ? 0.0 : kind == 1 ? 1.0 : 3.0;
      Disks disks = test::disks_of({{wall + 1.0 - beyond, 5.0, -2.0, 3.0, 1.0, 3.0}});
      disks.inertia = 0.5;
      disks.spin = {0.0};
      resolve_disk_at(disks, rules, kind == 2 ? obstacle_partner(0) : wall_partner(Side::left));
      const double lost = 0.1 * 1.5 * (kind == 1 ? 2.5 : 2.0);
      EXPECT_NEAR(disks.vy[0], 3.0 - lost, 1e-14) << kind;
      EXPECT_NEAR(disks.spin[0], lost / 0.5, 1e-14) << kind;
    }
  }
}

// A disk was pressed 0.1 deep into the floor, a fixed disk or a slope before the step. It is put back, and the energy
// for lifting it is taken from its motion: v'^2 = v^2 - 2 g_n 0.1. If that is more than there is, it rests. The same
// holds if gravity pulls to the left.
TEST(ResolveWall, LiftsADiskAtTheCostOfItsMotion) {
  for (const int kind : {0, 1, 2, 3}) {
    for (const double speed : {0.7, 0.3}) {
      StepRules rules = rules_of(kind == 3 ? Gravity(2.0, 0.0) : Gravity(2.0), 0.5);
      const Obstacle peg{10.0, 5.0, 0.0, 0.0, 2.0, 0.5, 0, ObstacleKind::disk};
      const Obstacle slope{7.0, 3.0, 4.0, 3.0, 0.0, 0.5, 0, ObstacleKind::wall};
      const ObstacleCells cells({kind == 2 ? slope : peg}, {}, rules.box);
      if (kind > 0) rules.box.obstacles = &cells;
      const Vec2 n = kind == 0 ? Vec2{0.0, 1.0} : kind == 3 ? Vec2{1.0, 0.0} : Vec2{-0.6, 0.8};
      const Vec2 touching = kind == 0   ? Vec2{3.0, 1.0}
                            : kind != 2 ? Vec2{10.0 + 3.0 * n.x, 5.0 + 3.0 * n.y}
                                        : Vec2{9.0 + n.x, 4.5 + n.y};
      Disks disks =
          test::disks_of({{touching.x - 0.1 * n.x, touching.y - 0.1 * n.y, -speed * n.x, -speed * n.y, 1.0, 3.0}});
      const WallImpact impact =
          resolve_disk_at(disks, rules, kind == 0 ? wall_partner(Side::bottom) : obstacle_partner(0));
      const double left = speed * speed - 2.0 * 2.0 * (kind == 3 ? n.x : n.y) * 0.1;
      const double away = 0.5 * std::sqrt(std::max(0.0, left));
      EXPECT_NEAR(disks.vx[0], away * n.x, 1e-14) << kind;
      EXPECT_NEAR(disks.vy[0], away * n.y, 1e-14) << kind;
      EXPECT_NEAR(disks.x[0], touching.x, 1e-14) << kind;
      EXPECT_NEAR(disks.y[0], touching.y, 1e-14) << kind;
      EXPECT_NEAR(impact.impulse, 3.0 * (speed + away), 1e-14) << kind;
      EXPECT_TRUE(impact.inaccurate) << kind;
    }
  }
}

// A disk that sticks to a fixed disk within the step, and would fall on, is back at it at the step's end.
TEST(ResolveWall, HoldsADiskThatGravityBringsBack) {
  StepRules rules = rules_of(50.0, 0.5);
  const ObstacleCells cells({{10.0, 5.0, 0.0, 0.0, 2.0, 0.0, 0, ObstacleKind::disk}}, {}, rules.box);
  rules.box.obstacles = &cells;
  Disks disks = test::disks_of({{10.0, 7.9, 0.0, -4.0, 1.0, 3.0}});
  EXPECT_FALSE(resolve_disk_at(disks, rules, obstacle_partner(0)).inaccurate);
  EXPECT_NEAR(disks.y[0], 8.0, 1e-12);
  EXPECT_NEAR(disks.vy[0], 0.0, 1e-6);
}

// A restitution that depends on speed is taken at the speed with which the disk reaches the obstacle: e = 1 - 0.5
// v^(1/5).
TEST(ResolveWall, AsksForTheRestitutionOfTheSpeedAtTheObstacle) {
  RestitutionLaw law;
  law.viscosity = 0.5;
  for (const double speed : {0.7, 2.0}) {  // lifted up to the obstacle, or met within the step
    StepRules rules = rules_of(speed < 1.0 ? 2.0 : 0.0, 0.0);
    rules.law = &law;
    const ObstacleCells cells({{10.0, 5.0, 0.0, 0.0, 2.0, 0.0, 7, ObstacleKind::disk}}, {}, rules.box);
    rules.box.obstacles = &cells;
    Disks disks = test::disks_of({{10.0, 7.9, 0.0, -speed, 1.0, 3.0}});
    resolve_disk_at(disks, rules, obstacle_partner(0));
    const double there = speed < 1.0 ? std::sqrt(0.49 - 0.4) : speed;
    EXPECT_NEAR(disks.vy[0], there * (1.0 - 0.5 * std::pow(there, 0.2)), 1e-14);
  }
}

// e = 1 - a v^(1/5) falls to its least value and no further; an inner wall, to which no law applies, has its own
// restitution.
TEST(RestitutionOfAContact, FallsToItsLeast) {
  EXPECT_DOUBLE_EQ(restitution_at({0.5, 0.25}, 1.0), 0.75);
  EXPECT_EQ(restitution_at({0.5, 0.25}, 1e6), 0.5);
  EXPECT_EQ(restitution_at({0.5, 0.0}, 1e6), 0.5);
  StepRules rules = rules_of(0.0, 0.0);
  const RestitutionLaw law{0.0, {1, 2}, {{0, 1, {0.75, 0.0}}}};  // for disk 0 with disk 1
  rules.law = &law;
  const Obstacle peg{5.0, 5.0, 0.0, 0.0, 1.0, 1.0, 1, ObstacleKind::disk};
  const Obstacle wall{5.0, 5.0, 2.0, 0.0, 0.0, 0.25, 1, ObstacleKind::wall};
  EXPECT_EQ(restitution_under_law(rules, 0, peg, 1.0), 0.75);
  EXPECT_EQ(restitution_under_law(rules, 0, wall, 1.0), 0.25);
}

// Whether a contact may lose energy is decided by the law of the two disks, fixed or not, by the wall's own
// restitution, or by the surfaces: those of disks for a pair, those of walls for a wall. A thermal side draws
// velocities, and its surface loses nothing.
TEST(RestitutionOfAContact, TellsWhetherItMayLoseEnergy) {
  const DiskId floor = wall_partner(Side::bottom);
  StepRules rules = rules_of(0.0, 1.0);
  const ObstacleCells cells({{5.0, 5.0, 0.0, 0.0, 1.0, 0.5, 1, ObstacleKind::disk}}, {}, rules.box);
  rules.box.obstacles = &cells;
  EXPECT_FALSE(may_lose_energy(rules, 0, 1) || may_lose_energy(rules, 0, floor));
  EXPECT_TRUE(may_lose_energy(rules, 0, obstacle_partner(0)));
  rules.box.restitutions[2] = 0.5;
  EXPECT_TRUE(may_lose_energy(rules, 0, floor));
  rules.box.restitutions[2] = 1.0;
  const RestitutionLaw law{0.0, {1, 2}, {{0, 1, {0.75, 0.0}}}};
  rules.law = &law;
  EXPECT_TRUE(may_lose_energy(rules, 0, 1) && may_lose_energy(rules, 0, obstacle_partner(0)));
  EXPECT_FALSE(may_lose_energy(rules, 0, 0) || may_lose_energy(rules, 0, 7) || may_lose_energy(rules, 0, floor));
  rules.law = nullptr;
  Surfaces surfaces;
  surfaces.inertia = 0.5;
  surfaces.walls = {0.5, 0.1};
  rules.surfaces = &surfaces;
  EXPECT_TRUE(may_lose_energy(rules, 0, floor));
  EXPECT_FALSE(may_lose_energy(rules, 0, 1));
  rules.box.temperatures[2] = 1.0;
  EXPECT_FALSE(may_lose_energy(rules, 0, floor));
}

// In a sheared box the shear stress is the virial along x and y: the momentum along x that is transferred along y. For
// a pair across the top the image's energy differs from the disk's by the jump times the momentum; that is the work of
// the shear.
TEST(SeeShear, CountsMomentumThatGoesAlongY) {
  const Relative r{0.6, 0.8, -1.0, -2.0};
  Shear shear;
  shear.rate = 0.5;
  shear.jump = 5.0;
  for (const int rows : {-1, 0, 1}) {
    PairImpact smooth;
    smooth.virial = 4.0;
    record_shear(smooth, r, rows, 2.4, false, shear);
    EXPECT_TRUE(smooth.sheared);
    EXPECT_DOUBLE_EQ(smooth.shear_virial, 4.0 * 0.48);
    EXPECT_DOUBLE_EQ(smooth.shear_work, -5.0 * rows * 2.4);
    PairImpact rough;
    rough.virial = 4.0;
    record_shear(rough, r, rows, 3.0, true, shear);
    EXPECT_DOUBLE_EQ(rough.shear_virial, 0.8 * 3.0);
  }
}

// A frame of rollback leaves no disk in a wall or in an obstacle, even if the disk moves away and nothing collides.
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

// A pair bounces at a distance (F2) if all disks go back further than to its contact; up to a billionth of the frame
// counts as rounding.
TEST(Rollback, TellsAPairThatBouncesAtADistance) {
  const StepRules rules = rules_of(0.0, 1.0);
  const ContactEvent e{0.0625, 0, 1, 0, 1};
  EXPECT_FALSE(is_at_a_distance(rules, e, 0.0625));
  EXPECT_FALSE(is_at_a_distance(rules, e, 0.0625 + 0.9e-9 * dt));
  EXPECT_TRUE(is_at_a_distance(rules, e, 0.0625 + 1.1e-9 * dt));
}

}  // namespace
}  // namespace carom
