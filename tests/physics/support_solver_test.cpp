// Contacts that bear load: the effect of a single support, moving walls included, and when the cycles that solve all
// supports end.
#include "core/physics/support_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/physics/impact_tally.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/settling_rules.hpp"

namespace carom {
namespace {

using test::contact_of;
using test::settling_rules;

constexpr double g = test::settling_gravity;
constexpr double dt = test::settling_dt;

// Begins the only support of a set.
Support begun(SupportSet& set, Disks& disks, const StepRules& rules, const ContactEvent& e, double force) {
  for (auto* column : {&set.impulse, &set.counted, &set.contact_distance}) column->resize(1);
  return with_view(disks, [&](const auto& d) {
    begin_support(set, 0, d, rules, e, force);
    return make_support(d, rules, e);
  });
}

// A floor that rises at 0.5 stops a disk falling at 2 at the floor's speed, with the impulse m (2 + 0.5), and does the
// work of that impulse; a fixed wall stops it at speed 0, without work.
TEST(WallSupport, StopsADiskInTheFrameOfTheWall) {
  for (const Side side : all_sides) {
    for (const double wall_speed : {0.0, 0.5}) {
      StepRules rules = settling_rules();
      const auto s = static_cast<std::size_t>(side);
      if (wall_speed > 0.0) {
        rules.box.motions[s] = {SideMotion::Kind::steady, 0.0, wall_speed};
        rules.box.step_walls(0.0, 1e-3);
      }
      const Vec2 n = inward_normal(side);
      Disks disks = test::disks_of({{5.0, 5.0, -2.0 * n.x, -2.0 * n.y, 1.0, 3.0}});
      SupportSet set;
      const Support support = begun(set, disks, rules, contact_of(0, wall_partner(side)), 0.0);
      set.v = {{disks.vx[0], disks.vy[0]}};
      relax(set.v.data(), support, set.impulse[0]);
      EXPECT_NEAR(set.v[0].x, wall_speed * n.x, 1e-12);
      EXPECT_NEAR(set.v[0].y, wall_speed * n.y, 1e-12);
      EXPECT_NEAR(set.impulse[0], 3.0 * (2.0 + wall_speed), 1e-12);
      ImpactTally tally;
      tally.add_load(wall_partner(side), support, borne(set, 0, support), rules.box);
      EXPECT_NEAR(tally.wall_impulse[s].value(), 3.0 * (2.0 + wall_speed), 1e-12);
      EXPECT_EQ(tally.wall_loads, 1U);
      if (wall_speed == 0.0) continue;
      EXPECT_NEAR(tally.side_energy[s].value(), 3.0 * 2.5 * 0.5, 1e-12);
    }
  }
}

// An inner wall with velocity (-0.3, 0.4) and normal (-3, 4) / 5 moves at 0.5 along its normal. It gives the disk the
// momentum of the impulse, and does that impulse's work at its own velocity.
TEST(WallSupport, OfAnInnerWallGivesMomentumAndWork) {
  StepRules rules = settling_rules();
  const Obstacle slope{1.0, 2.0, 4.0, 3.0, 0.0, 0.5, 0, ObstacleKind::wall, true};
  WallMotion motion;
  motion.pace = {SideMotion::Kind::steady, 0.0, 1.0};
  motion.along = {-0.3, 0.4};
  rules.box.inner_walls_move = true;
  ObstacleCells cells({slope}, {motion}, rules.box);
  rules.box.step_walls(0.0, 1e-3);
  cells.follow(0.0, 1e-3);
  rules.box.obstacles = &cells;
  Disks disks = test::disks_of({{3.0 - 0.6, 3.5 + 0.8, 1.2, -1.6, 1.0, 3.0}});
  SupportSet set;
  const Support support = begun(set, disks, rules, contact_of(0, obstacle_partner(0)), 0.0);
  set.v = {{disks.vx[0], disks.vy[0]}};
  relax(set.v.data(), support, set.impulse[0]);
  const double impulse = 3.0 * (2.0 + 0.5);
  EXPECT_NEAR(set.impulse[0], impulse, 1e-11);
  EXPECT_NEAR(set.v[0].x, -0.3, 1e-11);
  EXPECT_NEAR(set.v[0].y, 0.4, 1e-11);
  ImpactTally tally;
  tally.add_load(obstacle_partner(0), support, borne(set, 0, support), rules.box);
  ASSERT_EQ(tally.pushes.size(), 3U);
  EXPECT_NEAR(tally.pushes[0].value(), 0.5 * impulse, 1e-11);
  EXPECT_NEAR(tally.pushes[1].value(), -0.6 * impulse, 1e-11);
  EXPECT_NEAR(tally.pushes[2].value(), 0.8 * impulse, 1e-11);
  Counters counters;
  tally.count_into(counters);
  EXPECT_NEAR(counters.wall_work, 0.5 * impulse, 1e-11);
  EXPECT_NEAR(counters.wall_push[0], -0.6 * impulse, 1e-11);
}

// A load acts during the whole step, so the way is half its impulse times dt over the mass. The solver begins with the
// load of the step before; later rounds count only what is added.
TEST(Load, ActsAllThroughTheStep) {
  StepRules rules = settling_rules();
  Disks disks = test::disks_of({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {7.0, 5.0, 0.0, 0.0, 1.0, 4.0}});
  SupportSet set;
  Support support{};
  for (const int round : {0, 1}) {
    rules.round = round;
    support = begun(set, disks, rules, contact_of(0, 1), 6.0);
    EXPECT_DOUBLE_EQ(set.impulse[0], 6.0 * dt);
    set.impulse[0] += 0.25;
    EXPECT_NEAR(borne(set, 0, support), (round == 0 ? 6.0 * dt + 0.25 : 0.25) * 2.0, 1e-15);
  }
  with_view(disks, [&](const auto& d) { shift_by_load(d, support, 8.0, dt); });
  EXPECT_NEAR(disks.x[0], 5.0 - 0.5 * 8.0 * dt, 1e-15);
  EXPECT_NEAR(disks.x[1], 7.0 + 0.5 * 8.0 * dt / 4.0, 1e-15);
}

// Disks in one place bear on each other along x, the direction in which they are pushed apart.
TEST(Load, OfCoincidentDisksHasADirection) {
  const StepRules rules = settling_rules();
  Disks disks = test::disks_of({{5.0, 5.0, 1.0, 0.0, 1.0, 2.0}, {5.0, 5.0, -1.0, 0.0, 1.0, 2.0}});
  const Support s = with_view(disks, [&](const auto& d) { return make_support(d, rules, contact_of(0, 1)); });
  EXPECT_EQ(s.nx, 1.0);
  EXPECT_EQ(s.ny, 0.0);
  EXPECT_EQ(s.inverse1, 0.5);
  EXPECT_EQ(s.effective, 1.0);
}

// Parts of a step are tallied separately: the load of supports counts even if nothing collided.
TEST(Load, CountsWhereNothingCollides) {
  const StepRules rules = settling_rules();
  Disks disks = test::disks_of({{5.0, 1.0, 0.0, 0.0, 1.0, 1.0}, {7.0, 1.0, 0.0, 0.0, 1.0, 1.0}});
  SupportSet set;
  for (const DiskId other : {DiskId{1}, wall_partner(Side::bottom)}) {
    const Support support = begun(set, disks, rules, contact_of(0, other), 8.0);
    ImpactTally part;
    part.add_load(other, support, borne(set, 0, support), rules.box);
    ImpactTally all;
    all.add(part);
    Counters counters;
    all.count_into(counters);
    EXPECT_DOUBLE_EQ(counters.virial, is_wall(other) ? 0.0 : 8.0 * dt * 2.0);
    EXPECT_DOUBLE_EQ(counters.wall_impulse[2], is_wall(other) ? 8.0 * dt : 0.0);
  }
}

// For two disks the effective mass is their reduced mass; at a wall the load is the impulse alone, whatever the radius.
TEST(Load, IsOfTheMassThatTheContactFeels) {
  const StepRules rules = settling_rules();
  Disks disks = test::disks_of({{5.0, 0.5, 0.0, 0.0, 0.5, 3.0}, {6.0, 0.5, 0.0, 0.0, 0.5, 1.0}});
  SupportSet set;
  EXPECT_DOUBLE_EQ(begun(set, disks, rules, contact_of(0, 1), 8.0).effective, 0.75);
  const Support at_wall = begun(set, disks, rules, contact_of(0, wall_partner(Side::bottom)), 8.0);
  EXPECT_EQ(at_wall.effective, 3.0);
  EXPECT_DOUBLE_EQ(borne(set, 0, at_wall), 8.0 * dt);
}

// Sweeps whose changes are those that a script gives for each cycle.
struct ScriptedSweeps {
  std::function<CycleFigures(int)> script;
  double impulse = 0.0, mass = 1.0;  // sum over all supports
  mutable int cycles = 0;
  mutable std::vector<double> momenta;
  mutable std::vector<int> watched, weighed;

  template <Watch watch>
  CycleFigures cycle() const {
    ++cycles;
    if (watch == Watch::nothing) return {};
    watched.push_back(cycles);
    if (watch == Watch::all) weighed.push_back(cycles);
    return script(cycles);
  }
  void extrapolate(double momentum) const { momenta.push_back(momentum); }
  SupportTotals totals() const {
    SupportTotals all;
    all.add(impulse, mass);
    return all;
  }
};

constexpr double fall = g * dt;

CycleFigures changes(double largest, double strain = 0.0, double square = 0.0, double ahead = 1.0) {
  CycleFigures figures;
  figures.largest = largest;
  figures.strain = strain;
  figures.square.add(square);
  figures.ahead.add(ahead);
  return figures;
}

int cycles_of(const std::function<CycleFigures(int)>& script, double layers = 0.0) {
  const ScriptedSweeps sweeps{script, layers * fall, 1.0, 0, {}, {}, {}};
  solve_supports(settling_rules(), sweeps);
  return sweeps.cycles;
}

// There are at most twelve cycles, or twenty-four if something lands; they end as soon as changes are below 5e-4 of g
// dt, or of the first cycle's change.
TEST(SupportCycles, AreMoreWhereSomethingLands) {
  EXPECT_EQ(cycles_of([](int) { return changes(4.9e-4 * fall); }), 1);
  EXPECT_EQ(cycles_of([](int k) { return changes(k < 2 ? fall : 4.9e-4 * fall); }), 2);
  EXPECT_EQ(cycles_of([](int) { return changes(3.9 * fall); }), 12);
  EXPECT_EQ(cycles_of([](int) { return changes(4.1 * fall); }), 24);
  EXPECT_EQ(cycles_of([](int k) { return changes(k == 1 ? 5.0 : k < 14 ? 2.6e-3 : 2.4e-3); }), 16);
}

// Cycles go on, up to 256, while disks would be pressed together by more than a thousandth of their radii in a step.
TEST(SupportCycles, GoOnWhileDisksArePressedTogether) {
  const double much = 1.1e-3 / dt, little = 0.9e-3 / dt;
  EXPECT_EQ(cycles_of([&](int k) { return changes(fall, k < 99 ? much : little); }), 100);
  EXPECT_EQ(cycles_of([&](int) { return changes(fall, much); }), 256);
}

// In a pile of 200 layers that trembles cycles go on up to 40, or until it is calm; not if something lands.
TEST(SupportCycles, GoOnWhileAPileTrembles) {
  const double calm = 3e-4 * fall, trembling = fall;
  EXPECT_EQ(cycles_of([&](int) { return changes(fall, 0.0, 1.1 * calm * calm); }, 201.0), 40);
  EXPECT_EQ(cycles_of([&](int k) { return changes(fall, 0.0, (k < 20 ? 1.1 : 0.9) * calm * calm); }, 201.0), 20);
  EXPECT_EQ(cycles_of([&](int) { return changes(fall, 0.0, 0.9 * trembling * trembling); }, 201.0), 40);
  EXPECT_EQ(cycles_of([&](int) { return changes(fall, 0.0, 1.1 * trembling * trembling); }, 201.0), 12);
}

// Momentum grows with its age, and starts anew after an overshoot. Changes are looked at in the first two cycles, and
// in each fourth.
TEST(SupportCycles, TakeMomentumUntilItOvershoots) {
  const ScriptedSweeps sweeps{
      [](int k) { return changes(fall, 0.0, 0.0, k == 4 ? -1.0 : 1.0); }, 0.0, 1.0, 0, {}, {}, {}};
  solve_supports(settling_rules(), sweeps);
  const std::vector<double> first(sweeps.momenta.begin(), sweeps.momenta.begin() + 6);
  EXPECT_EQ(first, (std::vector<double>{0.0, 1.0 / 4.0, 2.0 / 5.0, 0.0, 1.0 / 4.0, 2.0 / 5.0}));
  EXPECT_EQ(sweeps.momenta.size(), 11U);
  EXPECT_EQ(sweeps.watched, (std::vector<int>{1, 2, 4, 8, 12}));
  EXPECT_EQ(sweeps.weighed, (std::vector<int>{4, 8, 12}));
}

// The figures of several parts: the larger ones, and the sums.
TEST(SupportCycles, HaveTheFiguresOfTheirParts) {
  for (const bool first_larger : {true, false}) {
    CycleFigures all = changes(first_larger ? 3.0 : 1.0, first_larger ? 0.5 : 0.25, 1.0, -2.0);
    all.add(changes(first_larger ? 1.0 : 3.0, first_larger ? 0.25 : 0.5, 2.0, -3.0));
    EXPECT_EQ(all.largest, 3.0);
    EXPECT_EQ(all.strain, 0.5);
    EXPECT_EQ(all.square.value(), 3.0);
    EXPECT_EQ(all.ahead.value(), -5.0);
  }
}

}  // namespace
}  // namespace carom
