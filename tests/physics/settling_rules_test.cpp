// The rules for disks that come to rest, for single contacts: what counts as a support, what overlap a loaded contact
// keeps, and how other disks are pushed apart.
#include "tests/support/settling_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/physics/push_apart.hpp"
#include "core/physics/resting.hpp"
#include "core/step/step_rounds.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

using test::contact_of;
using test::settling_rules;

constexpr double g = test::settling_gravity;
constexpr double dt = test::settling_dt;

// A contact is a support if its speed of approach is at most 64 g dt and one of its disks has another contact, or at
// most 2 g dt for a disk that only lies on a wall. Two disks without further contacts are not.
TEST(Support, IsASlowContact) {
  const StepRules rules = settling_rules();
  const auto is_support_at = [&](double speed, bool against_wall, bool loaded, bool crowded) {
    Disks disks = test::disks_of({{5.0, 1.0, 0.0, -speed, 1.0, 1.0}, {7.0, 1.0, -speed, 0.0, 1.0, 1.0}});
    const ContactEvent e = contact_of(0, against_wall ? wall_partner(Side::bottom) : 1);
    return with_view(disks,
                     [&](const auto& d) { return is_support(d, rules, e, {.loaded = loaded, .crowded = crowded}); });
  };
  for (const bool against_wall : {true, false}) {
    EXPECT_TRUE(is_support_at(63.9 * g * dt, against_wall, false, true));
    EXPECT_FALSE(is_support_at(64.1 * g * dt, against_wall, false, true));
    EXPECT_TRUE(is_support_at(1e3 * g * dt, against_wall, true, true));
    EXPECT_EQ(is_support_at(1.9 * g * dt, against_wall, false, false), against_wall);
    EXPECT_FALSE(is_support_at(2.1 * g * dt, against_wall, false, false));
    EXPECT_FALSE(is_support_at(2.1 * g * dt, against_wall, true, false));
  }
}

// Off the axes, too, the speed of approach is that along the line of centres.
TEST(Support, AsksForTheSpeedAlongTheLineOfCentres) {
  const StepRules rules = settling_rules();
  for (const double factor : {63.9, 64.1}) {
    const double speed = factor * g * dt;
    Disks disks = test::disks_of({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {6.2, 6.6, -0.6 * speed, -0.8 * speed, 1.0, 1.0}});
    EXPECT_EQ(
        with_view(disks, [&](const auto& d) { return is_support(d, rules, contact_of(0, 1), {.crowded = true}); }),
        factor < 64.0);
  }
}

// A wall that loses no energy lets a disk bounce for ever, and a thermal wall draws velocities: neither is a support.
TEST(Support, IsNoElasticWallAndNoThermalOne) {
  StepRules rules = settling_rules();
  Disks disks = test::disks_of({{5.0, 1.0, 0.0, 0.0, 1.0, 1.0}});
  const ContactEvent e = contact_of(0, wall_partner(Side::bottom));
  const auto support = [&](bool loaded, bool crowded) {
    return with_view(disks,
                     [&](const auto& d) { return is_support(d, rules, e, {.loaded = loaded, .crowded = crowded}); });
  };
  EXPECT_TRUE(support(false, false));
  rules.box.restitutions.fill(1.0);
  EXPECT_FALSE(support(false, false));
  rules.box.restitutions.fill(0.5);
  rules.box.temperatures[2] = 1.0;
  EXPECT_FALSE(support(false, false));
  EXPECT_FALSE(support(true, true));
}

// If a disk has two contacts, all its dissipating contacts are solved together, however fast they are.
TEST(Support, IsSolvedWithAllCrowdedContactsThatDissipate) {
  StepRules rules = settling_rules();
  Disks disks = test::disks_of({{5.0, 1.0, 0.0, 0.0, 1.0, 1.0}, {7.0, 1.0, -1e4 * g * dt, 0.0, 1.0, 1.0}});
  const auto solved = [&](bool crowded) {
    return with_view(disks, [&](const auto& d) { return is_solved(d, rules, contact_of(0, 1), {.crowded = crowded}); });
  };
  EXPECT_TRUE(solved(true));
  EXPECT_FALSE(solved(false));
  rules.restitution = 1.0;
  EXPECT_FALSE(solved(true));
}

// The speed is that in the frame of a moving side or inner wall.
TEST(Support, IsASlowContactInTheFrameOfTheWall) {
  StepRules rules = settling_rules();
  rules.box.places[2] = {0.0, 1.0, 0.0};
  const WallMotion up{{SideMotion::Kind::steady, 0.0, 1.0}, {0.0, 1.0}};
  Obstacle ledge{5.0, 5.0, 10.0, 0.0, 0.0, 0.5, 0, ObstacleKind::wall};
  ledge.moves = true;
  const ObstacleCells cells({ledge}, {up}, rules.box);
  rules.box.obstacles = &cells;
  for (const double speed : {1.9 * g * dt, 2.1 * g * dt}) {
    Disks disks = test::disks_of({{5.0, 1.0, 0.0, 1.0 - speed, 1.0, 1.0}, {9.0, 6.0, 0.0, 1.0 - speed, 1.0, 1.0}});
    with_view(disks, [&](const auto& d) {
      for (const ContactEvent& e : {contact_of(0, wall_partner(Side::bottom)), contact_of(1, obstacle_partner(0))}) {
        EXPECT_NEAR(normal_velocity(d, rules.box, e), -speed, 1e-14);
        EXPECT_EQ(is_support(d, rules, e, {}), speed < 2.0 * g * dt);
      }
    });
  }
}

// The load of a contact is that between the same two disks, not that of one of them with another disk.
TEST(Load, IsThatOfTheSameContact) {
  const std::vector<ContactLoad> loads{{0, 2, 3.0}, {1, 2, 5.0}};
  EXPECT_EQ(load_of(loads, contact_of(0, 2)), 3.0);
  EXPECT_EQ(load_of(loads, contact_of(1, 2)), 5.0);
  EXPECT_EQ(load_of(loads, contact_of(0, 1)), 0.0);
  EXPECT_EQ(load_of(loads, contact_of(0, 3)), 0.0);
  EXPECT_EQ(load_of(loads, contact_of(2, 3)), 0.0);
}

// The slack is 64 g dt^2, but at most half a percent of the sum of the radii (at a wall, of the radius).
TEST(Slack, IsThatOfAFewSteps) {
  StepRules rules = settling_rules();
  Disks disks = test::disks_of({{5.0, 3.0, 0.0, 0.0, 3.0, 1.0}, {9.0, 3.0, 0.0, 0.0, 1.0, 1.0}});
  const auto slack = [&](DiskId other) {
    return with_view(disks, [&](const auto& d) { return slack_of(d, rules, contact_of(0, other)); });
  };
  EXPECT_DOUBLE_EQ(slack(1), 64.0 * g * dt * dt);
  EXPECT_DOUBLE_EQ(slack(wall_partner(Side::bottom)), 64.0 * g * dt * dt);
  rules.whole_dt = 1.2 * dt;
  EXPECT_DOUBLE_EQ(slack(1), 64.0 * g * rules.whole_dt * rules.whole_dt) << "this step is shorter than the others";
  rules.dt = 0.1;
  EXPECT_DOUBLE_EQ(slack(1), 0.005 * 4.0);
  EXPECT_DOUBLE_EQ(slack(wall_partner(Side::bottom)), 0.005 * 3.0);
}

// A disk 0.3 beyond each side: a loaded contact keeps its slack, any other disk is put back to touch the wall.
TEST(PushApart, PutsADiskBackToAWall) {
  const Domain box = test::box_of(20.0, 10.0);
  for (const Side side : all_sides) {
    const Vec2 n = inward_normal(side);
    const bool along_x = n.x != 0.0;
    for (const double slack : {0.0, 0.1, 0.4}) {
      const double there = touching_coordinate(side, 1.0, box) - 0.3 * (n.x + n.y);
      Disks disks = test::disks_of({{along_x ? there : 5.0, along_x ? 5.0 : there, 0.5, 0.25, 1.0, 1.0}});
      with_view(disks, [&](const auto& d) { push_apart(d, box, contact_of(0, wall_partner(side)), slack); });
      EXPECT_NEAR(reach_beyond(side, disks.x[0], disks.y[0], 1.0, box), std::min(slack, 0.3), 1e-14);
      EXPECT_EQ(disks.vx[0], 0.5);
      EXPECT_EQ(along_x ? disks.y[0] : disks.x[0], 5.0);
    }
  }
}

// The displacements are divided by mass, so the centre of mass stays.
TEST(PushApart, PartsTwoDisksByMass) {
  const Domain box = test::box_of(20.0, 10.0);
  for (const double slack : {0.0, 0.05}) {
    Disks disks = test::disks_of({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {6.08, 6.44, 0.0, 0.0, 1.0, 3.0}});  // overlap 0.2
    with_view(disks, [&](const auto& d) { push_apart(d, box, contact_of(0, 1), slack); });
    const double pushed = 0.2 - slack;
    EXPECT_NEAR(disks.x[0], 5.0 - 0.75 * 0.6 * pushed, 1e-14);
    EXPECT_NEAR(disks.y[0], 5.0 - 0.75 * 0.8 * pushed, 1e-14);
    EXPECT_NEAR(disks.x[1], 6.08 + 0.25 * 0.6 * pushed, 1e-14);
    EXPECT_NEAR(disks.y[1], 6.44 + 0.25 * 0.8 * pushed, 1e-14);
  }
  Disks one_place = test::disks_of({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {5.0, 5.0, 0.0, 0.0, 1.0, 1.0}});
  with_view(one_place, [&](const auto& d) { push_apart(d, box, contact_of(0, 1), 0.0); });
  EXPECT_EQ(one_place.x[0], 4.0);
  EXPECT_EQ(one_place.x[1], 6.0);
}

// Walls and fixed disks do not give way: a disk pushed into one is left at most a thousandth of its radius in it.
TEST(PushApart, LeavesNoDiskInAWall) {
  Domain box = test::box_of(20.0, 10.0);
  const ObstacleCells cells({{12.5, 5.0, 0.0, 0.0, 0.5, 1.0}}, {}, box);
  box.obstacles = &cells;
  // Either disk of the pair is at the wall to the left or at the fixed disk.
  for (const bool second : {false, true}) {
    Disks left =
        test::disks_of({{second ? 2.6 : 1.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {second ? 1.0 : 2.6, 5.0, 0.0, 0.0, 1.0, 1.0}});
    with_view(left, [&](const auto& d) { push_apart(d, box, contact_of(0, 1), 0.0); });
    EXPECT_NEAR(left.x[second ? 1 : 0], 1.0 - 1e-3, 1e-14);
    EXPECT_NEAR(left.x[second ? 0 : 1], 2.8, 1e-14);
    Disks right = test::disks_of(
        {{second ? 11.0 : 9.4, 5.0, 0.0, 0.0, 1.0, 1.0}, {second ? 9.4 : 11.0, 5.0, 0.0, 0.0, 1.0, 1.0}});
    with_view(right, [&](const auto& d) { push_apart(d, box, contact_of(0, 1), 0.0); });
    EXPECT_NEAR(right.x[second ? 0 : 1], 11.0 + 1e-3, 1e-14);
  }
}

// The disk is moved out of a fixed disk along the line of centres.
TEST(PushApart, PutsADiskBackToAnObstacle) {
  Domain box = test::box_of(20.0, 10.0);
  const ObstacleCells cells({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}}, {}, box);
  box.obstacles = &cells;
  for (const double slack : {0.0, 0.1, 0.4}) {
    Disks disks = test::disks_of({{5.0 + 0.6 * 1.7, 5.0 + 0.8 * 1.7, 0.0, 0.0, 1.0, 1.0}});
    with_view(disks, [&](const auto& d) { push_apart(d, box, contact_of(0, obstacle_partner(0)), slack); });
    const double distance = 2.0 - std::min(slack, 0.3);
    EXPECT_NEAR(disks.x[0], 5.0 + 0.6 * distance, 1e-14);
    EXPECT_NEAR(disks.y[0], 5.0 + 0.8 * distance, 1e-14);
  }
}

// A contact is deep if its overlap exceeds a share of the sum of the radii plus the slack. Rounding must not decide on
// a disk that keep_inside has left in a wall by just that share.
TEST(PushApart, TellsWhatIsDeep) {
  const Domain box = test::box_of(20.0, 10.0);
  const auto deep = [&](const std::vector<Disk>& list, DiskId other, double slack) {
    Disks disks = test::disks_of(list);
    return with_view(disks, [&](const auto& d) { return is_deep(d, box, contact_of(0, other), 0.01, slack); });
  };
  const auto pair = [](double overlap) {
    return std::vector<Disk>{{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {8.0 - overlap, 5.0, 0.0, 0.0, 2.0, 1.0}};
  };
  EXPECT_TRUE(deep(pair(0.031), 1, 0.0));
  EXPECT_FALSE(deep(pair(0.029), 1, 0.0));
  EXPECT_TRUE(deep(pair(0.131), 1, 0.1));
  EXPECT_FALSE(deep(pair(0.129), 1, 0.1));
  const auto at_floor = [](double beyond) { return std::vector<Disk>{{5.0, 2.0 - beyond, 0.0, 0.0, 2.0, 1.0}}; };
  const DiskId floor = wall_partner(Side::bottom);
  EXPECT_TRUE(deep(at_floor(0.0201), floor, 0.0));
  EXPECT_TRUE(deep(at_floor(0.02 * (1.0 - 1e-9)), floor, 0.0));  // rounding does not decide
  EXPECT_FALSE(deep(at_floor(0.0199), floor, 0.0));
  EXPECT_TRUE(deep(at_floor(0.121), floor, 0.1));
  EXPECT_FALSE(deep(at_floor(0.119), floor, 0.1));
}

// Further sweeps push deep contacts only: those with an overlap above a tenth of a percent, or above half a percent
// after 32 sweeps or if the contact is loaded.
TEST(PushApart, GoesOnForWhatIsDeepEnough) {
  EXPECT_EQ(overlap_to_push(31, false), 1e-3);
  EXPECT_EQ(overlap_to_push(32, false), 5e-3);
  EXPECT_EQ(overlap_to_push(1, true), 5e-3);
  StepRules rules = settling_rules();
  EXPECT_EQ(push_sweeps(rules), 256);
  rules.settles = false;
  EXPECT_EQ(push_sweeps(rules), 4);
}

// The first sweep pushes all contacts, later sweeps those that are both crowded and deep.
TEST(PushApart, TakesCrowdedContactsAgain) {
  const StepRules rules = settling_rules();
  const auto pushed = [&](int sweep, bool crowded, double overlap) {
    Disks disks = test::disks_of({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {7.0 - overlap, 5.0, 0.0, 0.0, 1.0, 1.0}});
    return with_view(
        disks, [&](const auto& d) { return push_in_sweep(d, rules, contact_of(0, 1), sweep, {.crowded = crowded}); });
  };
  EXPECT_TRUE(pushed(0, false, 1e-6));
  EXPECT_FALSE(pushed(1, false, 0.1));
  EXPECT_TRUE(pushed(1, true, 0.1));
  EXPECT_FALSE(pushed(1, true, 1e-3));
}

// A disk that bears on a wall or an obstacle, and was lifted off by less than the slack, is put back in the first
// sweep; one further away is not.
TEST(PushApart, LaysALoadedDiskBack) {
  StepRules rules = settling_rules();
  const ObstacleCells cells({{5.0, 5.0, 0.0, 0.0, 1.0, 0.5}}, {}, rules.box);
  rules.box.obstacles = &cells;
  const double slack = 64.0 * g * dt * dt;
  ASSERT_GT(0.02, slack);
  const auto place_after = [&](double x, double y, DiskId other, int sweep, bool loaded) {
    Disks disks = test::disks_of({{x, y, 0.0, 0.0, 3.0, 1.0}});
    with_view(disks, [&](const auto& d) {
      push_in_sweep(d, rules, contact_of(0, other), sweep, {.loaded = loaded, .crowded = true});
    });
    return Vec2{disks.x[0], disks.y[0]};
  };
  const DiskId floor = wall_partner(Side::bottom);
  for (const double share : {0.9, 1.1}) {
    const double off = share * slack;
    const bool back = share < 1.0;
    EXPECT_EQ(place_after(15.0, 3.0 + off, floor, 0, true).y, back ? 3.0 : 3.0 + off);
    EXPECT_EQ(place_after(15.0, 3.0 + off, floor, 0, false).y, 3.0 + off);
    EXPECT_EQ(place_after(15.0, 3.0 + off, floor, 1, true).y, 3.0 + off);
    const Vec2 above = place_after(5.0 + 0.6 * (4.0 + off), 5.0 + 0.8 * (4.0 + off), obstacle_partner(0), 0, true);
    EXPECT_NEAR(std::hypot(above.x - 5.0, above.y - 5.0), back ? 4.0 : 4.0 + off, 1e-14);
  }
}

// A disk that was displaced by more than half a percent of its radius is looked at again; a disk that lies one percent
// deep in a wall or obstacle counts as pressed.
TEST(Rounds, GoOnForDisksThatAreDisplacedAndPressed) {
  Domain box = test::box_of(20.0, 10.0);
  const ObstacleCells cells({{12.0, 5.0, 0.0, 0.0, 1.0, 1.0}}, {}, box);
  box.obstacles = &cells;
  const auto displaced_by = [&](double way) {
    Disks disks = test::disks_of({{5.0 + 0.6 * way, 5.0 + 0.8 * way, 0.0, 0.0, 2.0, 1.0}});
    return with_view(disks, [&](const auto& d) { return is_displaced(d, box, 0, 5.0, 5.0); });
  };
  EXPECT_TRUE(displaced_by(0.0101));
  EXPECT_FALSE(displaced_by(0.0099));
  const auto in_wall = [&](double x, double y) {
    Disks disks = test::disks_of({{x, y, 0.0, 0.0, 2.0, 1.0}});
    return with_view(disks, [&](const auto& d) { return is_pressed_into_wall(d, box, 0); });
  };
  EXPECT_TRUE(in_wall(2.0 - 0.021, 5.0));
  EXPECT_FALSE(in_wall(2.0 - 0.019, 5.0));
  EXPECT_TRUE(in_wall(9.0 + 0.021, 5.0));
  EXPECT_FALSE(in_wall(9.0 + 0.019, 5.0));
  const auto pressed = [&](double overlap) {
    Disks disks = test::disks_of({{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}, {8.0 - overlap, 5.0, 0.0, 0.0, 2.0, 1.0}});
    return with_view(disks, [&](const auto& d) { return are_pressed(d, box, 0, 1); });
  };
  EXPECT_TRUE(pressed(0.031));
  EXPECT_FALSE(pressed(0.029));
}

}  // namespace
}  // namespace carom
