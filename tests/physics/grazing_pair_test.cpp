// Disks that just touch and pass along each other: by rounding no contact may be found, and then there is no time of
// contact either.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "core/disks/obstacle_cells.hpp"
#include "core/physics/exact_event.hpp"
#include "core/physics/parting.hpp"
#include "core/physics/resolve.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

TEST(GrazingPair, IsResolvedWhereItIs) {
  test::Draws draws(13);
  Scene scene = test::scene_of(Method::pairwise, 20.0, 20.0, 0.01, 1.0);
  int missed = 0;
  for (int k = 0; k < 20000; ++k) {
    const double angle = draws.in(0.0, 2.0 * std::numbers::pi);
    const double nx = std::cos(angle);
    const double ny = std::sin(angle);
    const double slide = draws.in(0.1, 10.0);
    Disks disks =
        test::disks_of({{10.0, 10.0, 0.0, 0.0, 0.5, 1.0}, {10.0 + nx, 10.0 + ny, -slide * ny, slide * nx, 0.5, 1.0}});
    with_view(disks, [&](const auto& d) {
      const Relative r = relative(d, 0, 1, scene.box);
      if (!touches(r.distance2(), 1.0) || !(r.approach() < 0.0)) return;
      missed += std::isinf(touching_time(r, 1.0)) ? 1 : 0;
      const PairImpact impact = resolve_pair(d, {scene.box, 1.0, 0.5, 0.01, true}, 0, 1);
      EXPECT_TRUE(std::isfinite(impact.virial));
      EXPECT_NEAR(d.x[0], 10.0, 1e-9);
      EXPECT_NEAR(d.y[1], 10.0 + ny, 0.01 * slide + 1e-9);
      EXPECT_GE(relative(d, 0, 1, scene.box).approach(), -1e-12);
    });
  }
  EXPECT_GT(missed, 0) << "no pair was missed, so this tests nothing";
}

// Velocities are corrected only if both paths begin at the contact, where rounding may make the disks approach.
TEST(Parting, IsOfPathsThatBothBeginAtTheContact) {
  for (const auto& [p, q, both] : {std::tuple(1.0, 1.0, true), std::tuple(0.5, 1.0, false), std::tuple(1.0, 0.5, false),
                                   std::tuple(0.5, 0.5, false)}) {
    EXPECT_EQ(both_begin_at(1.0, {p, 0.0, 0.0, 0.0, 0.0}, {q, 0.0, 0.0, 0.0, 0.0}), both) << p << " " << q;
  }
}

// Across the top of a sheared box the second disk's image moves with the jump, -1: along x it approaches at 1/2,
// although the velocities alone would separate at 1/2. The disks are parted by the least change that is enough, divided
// by mass, so momentum is conserved.
TEST(Parting, CountsTheJumpOfAShear) {
  PathSegment p{0.0, 0.0, 0.0, 1.0, 0.0}, q{0.0, 1.0, 0.0, 1.5, 0.0};
  const Relative r{1.0, 0.0, -0.5, 0.0};
  part_disks(r, shares(3.0, 1.0), -1.0, p, q);
  EXPECT_EQ(q.vx - p.vx - 1.0, 0.0);
  EXPECT_EQ(p.vx, 1.0 - 0.25 * 0.5);
  EXPECT_EQ(3.0 * p.vx + q.vx, 4.5);
  const PathSegment before = p;
  part_disks(r, shares(3.0, 1.0), -1.0, p, q);
  EXPECT_EQ(p.vx, before.vx) << "they do not approach any more, so nothing may change";
}

// Off the axes, too, the change is along the line of centres, divided by mass, so momentum is conserved.
TEST(Parting, IsAlongTheLineOfCentresByMass) {
  PathSegment p{0.0, 0.0, 0.0, 1.0, 2.0}, q{0.0, 0.6, 0.8, 0.5, 1.5};
  part_disks({0.6, 0.8, -0.5, -0.5}, shares(3.0, 1.0), 0.0, p, q);
  EXPECT_GE(0.6 * (q.vx - p.vx) + 0.8 * (q.vy - p.vy), 0.0);
  EXPECT_LE(0.6 * (q.vx - p.vx) + 0.8 * (q.vy - p.vy), 2.1 * 0.7);
  EXPECT_DOUBLE_EQ(3.0 * p.vx + q.vx, 3.5);
  EXPECT_DOUBLE_EQ(3.0 * p.vy + q.vy, 7.5);
  EXPECT_NEAR(0.8 * (q.vx - 0.5), 0.6 * (q.vy - 1.5), 1e-15);
}

// A moving wall catches up with a disk that moves away more slowly: they are parted in the wall's frame.
TEST(Parting, FromAWallIsInItsFrame) {
  const Vec2 line{0.6, 0.8}, wall{0.5, -0.25};
  for (const double approach : {0.125, -0.125}) {
    const Vec2 before{wall.x - approach * line.x, wall.y - approach * line.y};
    PathSegment p{0.0, 0.0, 0.0, before.x, before.y};
    part_from_wall(line, wall, p);
    const double away = line.x * (p.vx - wall.x) + line.y * (p.vy - wall.y);
    EXPECT_GE(away, 0.0);
    EXPECT_LE(away, 2.1 * 0.125);
    EXPECT_EQ(p.vx != before.x, approach > 0.0);
    EXPECT_NEAR(0.8 * (p.vx - before.x), 0.6 * (p.vy - before.y), 1e-15);
  }
}

// A unit vector n, and a velocity at right angles to it, in a random direction.
struct Grazing {
  Vec2 n, along;
};
Grazing graze(test::Draws& draws) {
  const double angle = draws.in(0.0, 2.0 * std::numbers::pi);
  const double slide = draws.in(0.1, 10.0);
  return {{std::cos(angle), std::sin(angle)}, {-slide * std::sin(angle), slide * std::cos(angle)}};
}

// Two disks that meet at the moment at which both paths begin, and approach only by rounding, must not approach
// afterwards; across the top of a sheared box, too.
TEST(Parting, LeavesNoDisksThatApproachByRounding) {
  test::Draws draws(29);
  ExactRules rules;
  rules.box = test::box_of(20.0, 20.0, test::Periodic::both);
  for (const bool sheared : {false, true}) {
    if (sheared) rules.box.shear = {0.5, 10.0, 3.0};
    int approached = 0;
    for (int k = 0; k < 2000; ++k) {
      const auto [n, along] = graze(draws);
      ExactDisk a, b;
      a.path = {0.5, 10.0, sheared ? 19.9 : 10.0, 0.0, 0.0};
      b.path = {0.5, a.path.x + n.x, a.path.y + n.y, along.x, along.y};
      if (sheared) b.path = {0.5, b.path.x - 8.0, b.path.y - 20.0, along.x - 10.0, along.y};
      if (sheared && n.y < 0.1) continue;  // the pair is not across the top
      const auto now = [&] {
        return sheared ? relative_in_shear(a.path, b.path, rules.box) : relative(a.path, b.path, rules.box);
      };
      const Relative met = now();
      if (!(met.approach() < 0.0)) continue;
      ++approached;
      collide_at(rules, 0.5, a, b);
      EXPECT_GE(met.dx * now().dvx + met.dy * now().dvy, 0.0) << k;
    }
    EXPECT_GT(approached, 10) << "too few pairs approached, so this tests nothing";
  }
}

// The same for a disk at the end of an inner wall, at rest or moving.
TEST(Parting, LeavesNoDiskThatApproachesAWallByRounding) {
  test::Draws draws(31);
  ExactRules rules;
  rules.box = test::box_of(20.0, 20.0, test::Periodic::both);
  for (const bool moves : {false, true}) {
    const Vec2 wall_speed = moves ? Vec2{0.3, 0.7} : Vec2{};
    Obstacle wall{8.0, 10.0, 2.0, 0.0, 0.0, 1.0, 0, ObstacleKind::wall};
    wall.moves = moves;
    const ObstacleCells cells({wall}, {WallMotion{{SideMotion::Kind::steady, 0.0, 1.0}, wall_speed}}, rules.box);
    rules.box.obstacles = &cells;
    const Vec2 end{10.0 + 0.5 * wall_speed.x, 10.0 + 0.5 * wall_speed.y};
    int approached = 0;
    for (int k = 0; k < 2000; ++k) {
      const auto [n, along] = graze(draws);
      if (n.x < 0.0) continue;  // the disk is not at the end of the wall
      ExactDisk a;
      a.radius = 1.0;
      a.path = {0.5, end.x + n.x, end.y + n.y, along.x + wall_speed.x, along.y + wall_speed.y};
      const auto approach = [&] {
        const Obstacle here = moves ? placed(wall, rules.box, 0.5).obstacle : wall;
        const Vec2 line = shortest_line_wound(here, a.path.x, a.path.y, rules.box).line;
        return line.x * (a.path.vx - wall_speed.x) + line.y * (a.path.vy - wall_speed.y);
      };
      if (!(approach() < 0.0)) continue;
      ++approached;
      meet_obstacle_at(rules, 0.5, 0, a);
      EXPECT_GE(approach(), 0.0) << k;
    }
    EXPECT_GT(approached, 10) << "too few disks approached, so this tests nothing";
  }
}

}  // namespace
}  // namespace carom
