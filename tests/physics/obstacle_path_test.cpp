// A disk and one obstacle: when a falling disk touches a round obstacle, a flat one or a sink, and what it touches
// where walls join, where centres coincide, and where images of one obstacle are close.
#include "core/physics/obstacle_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/physics/exact_path.hpp"
#include "core/physics/wall_overlap.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

// A disk that lies on a round obstacle and slides so slowly that gravity keeps it there, v^2 < g_n r, would have to
// follow the circle; on its parabola it would overlap at once. So its next contact is at once: it may move only as far
// as rounding allows.
TEST(FallPast, TouchesAtOnceWhereGravityPressesItOnSomethingRound) {
  const Gravity g(0.06);
  for (int k = 0; k < 2000; ++k) {
    const double angle = 0.3 + 0.0012 * k;  // angle from the horizontal
    const double contact = 0.2794163464055573 * (1.0 + 1e-3 * k);
    const double along = (k % 2 == 0 ? 0.9 : -0.5) * std::sqrt(0.06 * std::sin(angle) * contact);
    const FallPast fall{contact * std::cos(angle),
                        contact * std::sin(angle),
                        -along * std::sin(angle),
                        along * std::cos(angle),
                        g,
                        contact};
    const double t = std::min(time_to_contact_falling(fall, 10.0), 0.1);
    for (const double share : {0.25, 0.5, 1.0}) {
      EXPECT_GT(fall.gap2(share * t), -1e-12 * contact * contact) << "case " << k << ", time " << share * t;
    }
  }
}

// Closed forms from outside, such as 2 t + t^2 = 3, with the earlier root. There is no contact if the disk turns back
// before, or is beyond the plane. A disk that touches and moves away touches again when it has come back, after 2 v /
// a.
TEST(TimeToPlane, IsTheFirstRoot) {
  EXPECT_DOUBLE_EQ(time_to_plane(3.0, 2.0, 2.0, false), 1.0);
  EXPECT_DOUBLE_EQ(time_to_plane(3.0, -2.0, 2.0, false), 3.0);
  EXPECT_DOUBLE_EQ(time_to_plane(0.75, 2.0, -2.0, false), 0.5);
  EXPECT_EQ(time_to_plane(1.25, 2.0, -2.0, false), never);
  EXPECT_EQ(time_to_plane(-0.5, 2.0, 2.0, false), never);
  EXPECT_EQ(time_to_plane(-1.0, -1.0, 2.0, false), never);
  EXPECT_EQ(time_to_plane(3.0, -2.0, -2.0, false), never);
  EXPECT_EQ(time_to_plane(0.0, 2.0, -9.0, true), 0.0);
  EXPECT_DOUBLE_EQ(time_to_plane(-1e-17, -3.0, 2.0, true), 3.0);
  EXPECT_EQ(time_to_plane(-1e-17, -3.0, 0.0, true), never);
}

const Obstacle floor_piece{2.0, 5.0, 6.0, 0.0, 0.0, 1.0, 0, ObstacleKind::wall};

// A disk whose centre lies on a wall has to be put to one side of it: to the left of the wall's direction.
TEST(ObstacleGap, OfACentreOnTheObstacleHasADirection) {
  const Domain box = test::box_of(20.0, 10.0);
  const ObstacleGap on_wall = gap_to(floor_piece, 5.0, 5.0, 1.0, box);
  EXPECT_TRUE(on_wall.flat);
  EXPECT_EQ(on_wall.nx, 0.0);
  EXPECT_EQ(on_wall.ny, 1.0);
  EXPECT_EQ(on_wall.beyond, 1.0);
  const ObstacleGap on_peg = gap_to({5.0, 5.0, 0.0, 0.0, 2.0}, 5.0, 5.0, 1.0, box);
  EXPECT_EQ(on_peg.nx, 0.0);
  EXPECT_EQ(on_peg.ny, 1.0);
  EXPECT_EQ(on_peg.beyond, 3.0);
}

// A disk half-way between a fixed disk and its image, and large enough to touch both, has one contact, with the
// nearest.
TEST(ObstacleGap, OfTwoImagesTheNearestIsTouched) {
  Domain box = test::box_of(4.0, 10.0, test::Periodic::x);
  const ObstacleCells cells({{0.5, 5.0, 0.0, 0.0, 1.0}}, {}, box);
  box.obstacles = &cells;
  for (const double x : {2.4, 2.6}) {
    std::vector<ObstacleGap> gaps;
    for_each_obstacle_touched(box, x, 5.0, 1.5, [&](std::uint32_t, const ObstacleGap& gap) { gaps.push_back(gap); });
    ASSERT_EQ(gaps.size(), 1U);
    EXPECT_EQ(gaps[0].nx, x < 2.5 ? 1.0 : -1.0);
    EXPECT_NEAR(gaps[0].beyond, 2.5 - 1.9, 1e-15);
  }
}

// A sink takes a disk that touches it at once, even if the disk moves away; a wall in the same place is not met.
TEST(TimeToObstacle, IsNoneWhereADiskTouchesASink) {
  Obstacle sink = floor_piece;
  sink.kind = ObstacleKind::sink;
  const PathSegment leaving{0.0, 5.0, 6.0, 0.5, 3.0};
  const Vec2 apart{leaving.x - sink.x, leaving.y - sink.y};
  for (const Gravity g : {Gravity(0.0), Gravity(0.5)}) {
    EXPECT_EQ(time_to_obstacle(sink, apart, leaving, 1.0, g, 1.0), 0.0);
    EXPECT_GT(time_to_obstacle(floor_piece, apart, leaving, 1.0, g, 1.0), 1.0);
  }
  // A wall that vibrates with amplitude 0.25 and is at its middle now.
  WallMotion motion;
  motion.pace = {SideMotion::Kind::sine, 0.0, 0.0, 1.0, 40.0};
  motion.along = {0.0, -0.25};
  EXPECT_EQ(time_to_swinging_wall({sink, motion, motion.pace.at(0.0)}, apart, leaving, 1.0, 0.0, 1.0), 0.0);
  EXPECT_GT(time_to_swinging_wall({floor_piece, motion, motion.pace.at(0.0)}, apart, leaving, 1.0, 0.0, 1.0), 1.0);
}

// A wall whose vibration accelerates it more, or less, than gravity accelerates a disk: there is no overlap before the
// contact, at which the gap is 0.
TEST(TimeToSwingingWall, IsThatOfTheFirstContact) {
  constexpr double r = 0.5, span = 5.0;
  test::Draws draws(5);
  int contacts = 0;
  for (int k = 0; k < 1500; ++k) {
    WallMotion motion;
    motion.pace = {SideMotion::Kind::sine, 0.0, 0.0, 1.0, draws.decades(0.5, 30.0)};
    motion.along = {draws.in(-0.8, 0.8), draws.in(-0.8, 0.8)};
    const SidePlace now = motion.pace.at(draws.in(0.0, 50.0));
    const Gravity g(draws.in(-2.0, 2.0), draws.in(-3.0, 3.0));
    const PathSegment p{0.0, draws.in(-2.0, 8.0), draws.in(-3.0, 3.0), draws.in(-2.0, 2.0), draws.in(-2.0, 2.0)};
    const auto gap_at = [&](double t) {
      const double inset = motion.pace.swung(now, t).inset;
      const Vec2 at{p.x + p.vx * t - 0.5 * g.left * t * t - motion.along.x * inset,
                    p.y + p.vy * t - 0.5 * g.down * t * t - motion.along.y * inset};
      return shortest_line(floor_piece, at).distance - r;
    };
    if (gap_at(0.0) < 1e-3) continue;
    const double found = time_to_swinging_wall({floor_piece, motion, now}, {p.x, p.y}, p, r, g, span);
    const double until = std::min(found, span);
    for (int j = 0; j < 250; ++j) ASSERT_GT(gap_at(until * j / 250.0), -1e-12) << k << ", " << j;
    if (found == HUGE_VAL) continue;
    ++contacts;
    ASSERT_NEAR(gap_at(found), 0.0, 1e-11) << k;
  }
  EXPECT_GT(contacts, 300);
}

// This holds beyond the ends of a wall, too, where a disk may rise beside it and fall back on it.
TEST(TimeToObstacle, IsThatOfTheFirstContact) {
  constexpr double r = 0.5, span = 5.0;
  test::Draws draws(6);
  int contacts = 0;
  for (int k = 0; k < 4000; ++k) {
    const Gravity g(draws.in(-2.0, 2.0), draws.in(-3.0, 3.0));
    const PathSegment p{0.0, draws.in(-1.0, 7.0), draws.in(-1.0, 1.0), draws.in(-2.0, 2.0), draws.in(-2.0, 2.0)};
    const auto gap_at = [&](double t) {
      const Vec2 at{p.x + p.vx * t - 0.5 * g.left * t * t, p.y + p.vy * t - 0.5 * g.down * t * t};
      return shortest_line(floor_piece, at).distance - r;
    };
    if (gap_at(0.0) < 1e-3) continue;
    const double found = time_to_obstacle(floor_piece, {p.x, p.y}, p, r, g, span);
    const double until = std::min(found, span);
    for (int j = 0; j < 100; ++j) ASSERT_GT(gap_at(until * j / 100.0), -1e-12) << k << ", " << j;
    if (found > span) continue;
    ++contacts;
    ASSERT_NEAR(gap_at(found), 0.0, 1e-11) << k;
    ASSERT_EQ(time_to_obstacle(floor_piece, {p.x, p.y}, p, r, g, found * (1.0 + 1e-9)), found) << k;
  }
  EXPECT_GT(contacts, 800);
}

// For any direction of gravity the approach to a round obstacle is monotone between its turns, where its slope is 0.
TEST(FallPast, TurnsWhereTheApproachHasNoSlope) {
  test::Draws draws(8);
  int turns = 0;
  for (int k = 0; k < 1000; ++k) {
    const FallPast fall{draws.in(-5.0, 5.0),
                        draws.in(-5.0, 5.0),
                        draws.in(-1.0, 1.0),
                        draws.in(-1.0, 1.0),
                        {draws.in(-2.0, 2.0), draws.in(-2.0, 2.0)},
                        1.0};
    const ApproachTurns found = turns_of(fall);
    if (!found.real) {
      for (int j = -100; j <= 100; ++j) ASSERT_GE(fall.approach_slope(0.2 * j), -1e-12) << k;
      continue;
    }
    ++turns;
    for (const double t : found.time) ASSERT_NEAR(fall.approach_slope(t), 0.0, 1e-9 * (1.0 + t * t)) << k;
  }
  EXPECT_GT(turns, 300);
}

// In a periodic box a disk touches an obstacle only once, whichever image of it is touched; so it is for a wall that
// has gone around many times. The contact is as with an obstacle placed there.
TEST(ObstacleGap, OfImagesAndOfWallsThatWentRoundIsSeenOnce) {
  test::Draws draws(9);
  for (const int kind : {0, 1, 2}) {  // a fixed disk, an inner wall, a moving inner wall
    Domain box = test::box_of(10.0, 12.0, test::Periodic::both);
    Obstacle o{9.0, 11.0, 0.0, 0.0, 1.5, 1.0, 0, ObstacleKind::disk};
    if (kind > 0) o = {7.0, 11.5, 3.0, -1.0, 0.0, 1.0, 0, ObstacleKind::wall};
    o.moves = kind == 2;
    ObstacleCells cells({o}, {WallMotion{{SideMotion::Kind::steady, 0.0, 1.0}, {1.0, -1.0}}}, box);
    box.obstacles = &cells;
    Obstacle there = o;
    if (kind == 2) {
      cells.follow(37.0, 37.0);
      box.inner_walls_move = true;
      box.move_walls(37.0);
      there = {4.0, 10.5, 3.0, -1.0, 0.0, 1.0, 0, ObstacleKind::wall};  // 37 on: 40 (5 rounds) minus 3; and 36 and 1
    }
    int touched = 0;
    for (int k = 0; k < 2000; ++k) {
      const double x = draws.in(0.0, 10.0), y = draws.in(0.0, 12.0), r = 0.75;
      const ObstacleGap placed_there = gap_to(there, x, y, r, box);
      EXPECT_NEAR(gap_to(o, x, y, r, box).beyond, placed_there.beyond, 1e-12) << kind;
      if (std::abs(placed_there.beyond) < 1e-9) continue;
      int seen = 0;
      for_each_obstacle_touched(box, x, y, r, [&](std::uint32_t, const ObstacleGap& gap) {
        ++seen;
        EXPECT_NEAR(gap.nx, placed_there.nx, 1e-9);
        EXPECT_NEAR(gap.ny, placed_there.ny, 1e-9);
      });
      EXPECT_EQ(seen, placed_there.beyond > 0.0 ? 1 : 0) << kind << " at " << x << ", " << y;
      touched += seen;
    }
    EXPECT_GT(touched, 100);
  }
}

// A wall that moves steadily, along a parabola or as a sine is first met when its gap is 0, even if the disk hardly
// moves, and even if the time searched is hardly longer.
TEST(TimeToMovingWall, IsThatOfTheFirstContact) {
  constexpr double r = 0.5, span = 2.5;
  test::Draws draws(7);
  const SideMotion paces[] = {{SideMotion::Kind::steady, 0.0, 1.0},
                              {SideMotion::Kind::parabolas, 0.0, 0.0, 1.0, 8.0},
                              {SideMotion::Kind::sine, 0.0, 0.0, 1.0, 3.0}};
  Obstacle wall = floor_piece;
  wall.moves = true;
  for (const SideMotion& pace : paces) {
    int contacts = 0;
    for (int m = 0; m < 8; ++m) {
      Domain box{40.0, 40.0};
      const WallMotion motion{pace, {draws.in(-1.5, 1.5), draws.in(-1.5, 1.5)}};
      const ObstacleCells cells({wall}, {motion}, box);
      box.obstacles = &cells;
      for (int k = 0; k < 150; ++k) {
        const Gravity g(draws.in(-0.5, 0.5), draws.in(-0.5, 0.5));
        const PathSegment p{draws.in(0.0, 1.0), draws.in(0.0, 10.0), draws.in(2.0, 8.0), draws.in(-0.3, 0.3),
                            draws.in(-0.3, 0.3)};
        const auto gap_at = [&](double t) {
          const double inset = pace.at(p.start + t).inset;
          const Vec2 at{p.x + p.vx * t - 0.5 * g.left * t * t - motion.along.x * inset - wall.x,
                        p.y + p.vy * t - 0.5 * g.down * t * t - motion.along.y * inset - wall.y};
          return shortest_line(wall, at).distance - r;
        };
        if (gap_at(0.0) < 1e-3) continue;
        const auto time = [&](double longest) {
          return time_to_moving_wall(wall, {p.x - wall.x, p.y - wall.y}, p, r, box, g, longest);
        };
        const double found = time(span);
        const double until = std::min(found, span);
        for (int j = 0; j < 50; ++j) ASSERT_GT(gap_at(until * j / 50.0), -1e-11) << m << " " << k << ", " << j;
        if (found > span) continue;
        ++contacts;
        ASSERT_NEAR(gap_at(found), 0.0, 1e-10) << m << " " << k;
        ASSERT_EQ(time(found * (1.0 + 1e-9)), found) << m << " " << k;
      }
    }
    EXPECT_GT(contacts, 100);
  }
}

// Where the end of one wall lies on the side of another, a disk there touches only the side. If each contact hid the
// other, the disk would fall through.
TEST(Joint, TheSideIsTouchedAndTheEndIsHidden) {
  const Domain box = test::box_of(20.0, 10.0);
  const Obstacle post{5.0, 2.0, 0.0, 3.0, 0.0, 1.0, 1, ObstacleKind::wall};  // up to the middle of floor_piece
  const double r = 1.0;
  const ObstacleGap side = gap_to(floor_piece, 5.0, 5.9, r, box);
  const ObstacleGap end = gap_to(post, 5.0, 5.9, r, box);
  ASSERT_TRUE(side.flat);
  ASSERT_FALSE(end.flat);
  for (const bool is_later : {false, true}) {
    EXPECT_TRUE(hides(side, is_later, end, r, box));
    EXPECT_FALSE(hides(end, is_later, side, r, box));
  }
  // If two ends coincide, or one wall is given twice, the later one is hidden.
  const Obstacle on_the_way{8.0, 5.0, 4.0, 0.0, 0.0, 1.0, 2, ObstacleKind::wall};
  const ObstacleGap first_end = gap_to(floor_piece, 8.0, 5.9, r, box);
  const ObstacleGap second_end = gap_to(on_the_way, 8.0, 5.9, r, box);
  EXPECT_TRUE(hides(first_end, true, second_end, r, box));
  EXPECT_FALSE(hides(second_end, false, first_end, r, box));
}

// Ends and sides that a disk touches in different points are separate contacts: one beside it and one below it, or two
// ends one above the other.
TEST(Joint, OtherPointsAreOtherContacts) {
  const auto wall = [](double x, double y, double dx, double dy) {
    return Obstacle{x, y, dx, dy, 0.0, 1.0, 0, ObstacleKind::wall};
  };
  for (const auto& pair : {std::vector<Obstacle>{wall(2.0, 5.0, 6.0, 0.0), wall(6.0, 6.0, 3.0, 0.0)},
                           std::vector<Obstacle>{wall(5.6, 6.8, 2.0, 2.0), wall(5.6, 5.2, 2.0, -2.0)}}) {
    Domain box = test::box_of(20.0, 20.0);
    const ObstacleCells cells(pair, {}, box);
    box.obstacles = &cells;
    int seen = 0;
    for_each_solid_touched(box, 5.0, 6.0, 1.0 + 1e-9, [&](std::uint32_t k, const ObstacleGap& gap) {
      ++seen;
      EXPECT_FALSE(is_hidden(box, k, gap, 5.0, 6.0, 1.0 + 1e-9)) << k;
    });
    EXPECT_EQ(seen, 2);
  }
}

// Walls that move differently make two contacts in one place: each gives the disk its own velocity.
TEST(Joint, WallsOfOtherVelocitiesHideNothing) {
  const Domain box = test::box_of(20.0, 10.0);
  const Obstacle post{5.0, 2.0, 0.0, 3.0, 0.0, 1.0, 1, ObstacleKind::wall};
  const ObstacleGap end = gap_to(post, 5.0, 5.9, 1.0, box);
  for (const Vec2 velocity : {Vec2{0.0, 0.0}, Vec2{0.5, 0.0}, Vec2{0.0, 0.5}}) {
    ObstacleGap side = gap_to(floor_piece, 5.0, 5.9, 1.0, box);
    side.velocity = velocity;
    EXPECT_EQ(hides(side, false, end, 1.0, box), velocity.x == 0.0 && velocity.y == 0.0);
  }
}

// The overlap with a fixed disk is the depth of the gap over the radius. A disk that lies in a wall where a sink is an
// opening is about to be taken, and overlaps nothing.
TEST(WallOverlap, IsOfWallsAndObstaclesButNotInAnOpening) {
  Domain box = test::box_of(20.0, 10.0);
  Obstacle sink{2.0, 0.0, 6.0, 0.0, 0.0, 1.0, 1, ObstacleKind::sink};
  const ObstacleCells cells({sink, {15.0, 5.0, 0.0, 0.0, 1.0}}, {}, box);
  box.obstacles = &cells;
  const auto deepest = [&](double x, double y) {
    Overlap overlap;
    raise_to_wall_overlap(x, y, 2.0, 7, box, overlap);
    return overlap;
  };
  EXPECT_EQ(deepest(5.0, 1.5).size, 0.0);
  EXPECT_EQ(deepest(11.0, 1.5).size, 0.25);
  for (const double in : {0.1, 0.5, 1.5}) {
    const Overlap found = deepest(12.0 + in, 5.0);
    EXPECT_NEAR(found.size, in / 2.0, 1e-15);
    EXPECT_EQ(found.id2, obstacle_partner(1));
  }
}

// A disk falls for a time t from its contact, and that time must be found again: at a slope to rounding; at a round
// obstacle by two of Newton's steps from the straight path, which is wrong by a tenth here, and after one step by a
// thousandth.
TEST(TimeSinceObstacle, UndoesTheFall) {
  const Gravity g(0.5, 2.0);
  const double t = 0.1;
  const Domain box = test::box_of(20.0, 10.0);
  const Obstacle peg{8.0, 5.0, 0.0, 0.0, 2.0};
  const Obstacle slope{4.0, 2.0, 8.0, 6.0, 0.0, 1.0, 0, ObstacleKind::wall};
  for (const double angle : {0.4, 1.0, 1.57, 2.5}) {
    for (const double turned : {-0.6, 0.0, 0.6}) {
      double x = peg.x + 3.0 * std::cos(angle);
      double y = peg.y + 3.0 * std::sin(angle);
      double vx = -std::cos(angle + turned);
      double vy = -std::sin(angle + turned);
      drift<true>(x, y, vx, vy, t, g);
      const ObstacleGap gap = gap_to(peg, x, y, 1.0, box);
      ASSERT_GT(gap.beyond, 0.0);
      EXPECT_NEAR(time_since_obstacle(peg, gap, 1.0, vx, vy, g) / t, 1.0, 1e-6) << angle << ", " << turned;
    }
  }
  double x = 8.0 - 0.6, y = 5.0 + 0.8, vx = 0.9, vy = -0.2;
  drift<true>(x, y, vx, vy, t, g);
  const ObstacleGap gap = gap_to(slope, x, y, 1.0, box);
  ASSERT_TRUE(gap.flat);
  EXPECT_NEAR(time_since_obstacle(slope, gap, 1.0, vx, vy, g) / t, 1.0, 1e-13);
  // A disk that was never outside: it lies deeper than its speed can have carried it.
  EXPECT_EQ(time_since_flat({0.0, 1.0, 1.0, true}, 1.0, Gravity(0.75)), HUGE_VAL);
}

}  // namespace
}  // namespace carom
