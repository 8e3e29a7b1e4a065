// Sizes, velocities and columns of initial states, and independence of units; positions are tested in placement_test.
#include "core/start/initial_state.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/start/initial_velocities.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/other_units.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::Draws;
using test::scaled;
using test::scene_from;
using test::Units;
using testing::ElementsAre;

// A large box with these groups.
Scene scene_with(std::string_view groups, std::uint64_t seed = 3) {
  return scene_from(fmt::format("seed = {}\n[box]\nwidth = 200\nheight = 100\n{}\n[run]\nt_end = 1\n", seed, groups));
}

std::string group(std::string_view radius, std::string_view mass, Count count = 100, std::string_view more = "") {
  return fmt::format("[[disks]]\ncount = {}\npositions = \"random\"\nradius = {}\nmass = {}\n{}\n", count, radius, mass,
                     more);
}

TEST(Sizes, EqualOnesNeedNoColumn) {
  const State s = initial_state(scene_with(group("0.5", "2") + group("0.5", "2")));
  EXPECT_EQ(s.disks.size(), 200U);
  EXPECT_TRUE(s.disks.radius.empty());
  EXPECT_TRUE(s.disks.mass.empty());
  EXPECT_EQ(s.disks.common_radius, 0.5);
  EXPECT_EQ(s.disks.common_mass, 2.0);
  EXPECT_EQ(s.next_id, 200U);
}

TEST(Sizes, EachColumnExistsOnlyWhereDisksDiffer) {
  const State masses = initial_state(scene_with(group("0.5", "2") + group("0.5", "3")));
  EXPECT_TRUE(masses.disks.radius.empty());
  EXPECT_EQ(masses.disks.common_radius, 0.5);
  EXPECT_EQ(masses.disks.mass.size(), 200U);
  EXPECT_EQ(masses.disks.mass[99], 2.0);
  EXPECT_EQ(masses.disks.mass[100], 3.0);
  const State radii = initial_state(scene_with(group("0.5", "2") + group("0.25", "2")));
  EXPECT_EQ(radii.disks.radius.size(), 200U);
  EXPECT_TRUE(radii.disks.mass.empty());
  const State list = initial_state(scene_with(group("[0.5, 0.5]", "{ uniform = [2, 2] }", 2)));
  EXPECT_TRUE(list.disks.radius.empty()) << "equal radii, given as a list, must make no column";
  EXPECT_TRUE(list.disks.mass.empty());
  EXPECT_EQ(list.disks.common_mass, 2.0);
}

TEST(Sizes, WithoutDisksTheSourceSaysThem) {
  const Scene scene = scene_with("[[sources]]\nside = \"left\"\nrate = 1\nradius = 0.5\nmass = { from_radius = 2 }");
  const State s = initial_state(scene);
  EXPECT_TRUE(s.disks.empty());
  EXPECT_EQ(s.disks.common_radius, 0.5);
  EXPECT_DOUBLE_EQ(s.disks.common_mass, std::numbers::pi * 2 * 0.25);
  EXPECT_EQ(s.sources.size(), 1U);
  EXPECT_EQ(s.next_id, 0U);
  EXPECT_TRUE(initial_state(scene_with(group("1", "1", 0))).disks.empty());
  // Fixed disks are no longer among the disks, and must not affect their columns.
  const std::string pegs = "[[disks]]\nfixed = true\ncount = 2\npositions = [[1, 1], [9, 9]]\nradius = [1.0, 2.0]\n";
  const State beside =
      initial_state(scene_with(pegs + "[[sources]]\nside = \"left\"\nrate = 1\nradius = 0.5\nmass = 3.0"));
  EXPECT_TRUE(beside.disks.empty() && beside.disks.radius.empty() && beside.disks.mass.empty());
  EXPECT_EQ(beside.disks.common_radius, 0.5);
  EXPECT_EQ(beside.disks.common_mass, 3.0);
  EXPECT_EQ(beside.next_id, 2U) << "ids are never reused";
}

TEST(Sizes, UniformOnesLieInTheirRangeAndFillIt) {
  const Scene scene = scene_with(group("{ uniform = [0.1, 0.5] }", "{ uniform = [1, 100] }", 1000));
  std::vector<double> radii;
  std::vector<double> masses;
  draw_sizes(scene, scene.groups[0], 0, radii, masses);
  double sum = 0.0;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    EXPECT_GE(radii[k], 0.1);
    EXPECT_LE(radii[k], 0.5);
    EXPECT_GE(masses[k], 1.0);
    EXPECT_LE(masses[k], 100.0);
    sum += masses[k];
  }
  EXPECT_NEAR(sum / 1000.0, 50.5, 4.0 * 99.0 / std::sqrt(12.0 * 1000.0)) << "mean within four standard errors";
}

TEST(Sizes, FollowTheDiskNotTheGroup) {
  const Scene one = scene_with(group("{ uniform = [0.1, 0.5] }", "1", 100));
  const Scene two = scene_with(group("{ uniform = [0.1, 0.5] }", "1", 40) + group("{ uniform = [0.1, 0.5] }", "1", 60));
  EXPECT_EQ(initial_state(one).disks.radius, initial_state(two).disks.radius);
  EXPECT_EQ(state_hash(initial_state(one).disks), state_hash(initial_state(two).disks));
}

TEST(Sizes, DerivedFromEachOther) {
  const State from_mass = initial_state(scene_with(group("{ from_mass = 4 }", "{ uniform = [1, 10] }", 50)));
  const State from_radius = initial_state(scene_with(group("{ uniform = [0.1, 0.5] }", "{ from_radius = 4 }", 50)));
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_DOUBLE_EQ(from_mass.disks.radius[i], std::sqrt(from_mass.disks.mass[i] / (std::numbers::pi * 4)));
    EXPECT_DOUBLE_EQ(from_radius.disks.mass[i],
                     std::numbers::pi * 4 * from_radius.disks.radius[i] * from_radius.disks.radius[i]);
  }
}

TEST(Velocities, AtRestUnlessSaid) {
  const State s = initial_state(scene_with(group("0.5", "1")));
  EXPECT_THAT(s.disks.vx, testing::Each(0.0));
  EXPECT_THAT(s.disks.vy, testing::Each(0.0));
}

TEST(Velocities, ListsAreTakenAsTheyAre) {
  const State s =
      initial_state(scene_with(group("1", "1", 1) + group("1", "1", 2, "velocities = [[1, 2], [-3, 0.1]]")));
  EXPECT_THAT(s.disks.vx, ElementsAre(0, 1, -3));
  EXPECT_THAT(s.disks.vy, ElementsAre(0, 2, 0.1));
}

TEST(Velocities, UniformOnesHaveEitherSign) {
  const State s = initial_state(scene_with(group("0.5", "1", 500, "velocities = { uniform = 2 }")));
  int positive = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_LE(std::abs(s.disks.vx[i]), 2.0);
    EXPECT_LE(std::abs(s.disks.vy[i]), 2.0);
    positive += s.disks.vx[i] > 0 ? 1 : 0;
  }
  EXPECT_NEAR(positive, 250, 4 * std::sqrt(125.0));
}

// Each group separately has mean velocity 0 and kinetic energy count * T, for any masses.
TEST(Velocities, MaxwellIsExactInEachGroup) {
  Draws draws(31);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double t = draws.decades(1e-6, 1e6);
    const auto more = fmt::format("velocities = {{ maxwell = {:.17g} }}", t);
    const Count n = 2 + draws.bits() % 60;
    const State s = initial_state(scene_with(
        group("0.5", "{ uniform = [1, 100] }", n, more) + group("0.5", "7", 10, "velocities = { uniform = 1 }"), seed));
    double mass = 0.0;
    double px = 0.0;
    double py = 0.0;
    double kinetic = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double m = s.disks.mass[i];
      mass += m;
      px += m * s.disks.vx[i];
      py += m * s.disks.vy[i];
      kinetic += 0.5 * m * (s.disks.vx[i] * s.disks.vx[i] + s.disks.vy[i] * s.disks.vy[i]);
    }
    const double expected = static_cast<double>(n) * t;
    EXPECT_NEAR(kinetic / expected, 1.0, 1e-13);
    EXPECT_LE(std::sqrt(px * px + py * py), 1e-12 * std::sqrt(2 * mass * expected));
  }
}

TEST(Velocities, MaxwellIsNormal) {
  const State s = initial_state(scene_with(group("0.05", "1", 20000, "velocities = { maxwell = 4 }")));
  double fourth = 0.0;
  for (const double v : s.disks.vx) fourth += v * v * v * v / 16.0;
  EXPECT_NEAR(fourth / 20000.0, 3.0, 4 * std::sqrt(96.0 / 20000.0)) << "fourth moment of a normal deviate";
}

// A shear flow is at rest half-way up, and is added to the velocities of the groups.
TEST(Velocities, AShearFlowIsAtRestHalfWayUp) {
  const State s = initial_state(scene_from(
      "[box]\nwidth = 20\nheight = 10\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
      "top = \"periodic\"\nshear_rate = 0.5\n[[disks]]\ncount = 3\npositions = [[5, 1], [5, 5], [5, 8]]\n"
      "velocities = [[1, 2], [3, 4], [5, 6]]\nradius = 0.5\nmass = 1\n[run]\nmethod = \"exact\"\nt_end = 1\n"));
  EXPECT_THAT(s.disks.vx, ElementsAre(-1.0, 3.0, 6.5));
  EXPECT_THAT(s.disks.vy, ElementsAre(2.0, 4.0, 6.0));
}

// Spins drawn by temperature: the mean of I w^2 is T (1 +- sqrt(2 / n)) with I = q m r^2, for any disks; a list of
// spins is taken as it is.
TEST(Spins, ThermalOnesGoByTheMomentOfInertia) {
  const Scene scene = scene_with(group("1", "1"));
  const double one = thermal_spin(scene, 2.0, 5, 0.5, 1.0, 1.0);
  EXPECT_DOUBLE_EQ(thermal_spin(scene, 8.0, 5, 0.5, 1.0, 1.0), 2.0 * one);
  EXPECT_DOUBLE_EQ(thermal_spin(scene, 2.0, 5, 0.5, 1.0, 4.0), 0.25 * one);
  EXPECT_DOUBLE_EQ(thermal_spin(scene, 2.0, 5, 0.5, 4.0, 1.0), 0.5 * one);
  EXPECT_DOUBLE_EQ(thermal_spin(scene, 2.0, 5, 0.125, 1.0, 1.0), 2.0 * one);
  double sum = 0.0;
  for (DiskId id = 0; id < 20000; ++id) {
    const double w = thermal_spin(scene, 2.0, id, 0.5, 3.0, 0.7);
    sum += 0.5 * 3.0 * 0.7 * 0.7 * w * w;
  }
  EXPECT_NEAR(sum / 20000.0, 2.0, 4.0 * 2.0 * std::sqrt(2.0 / 20000.0));
  const Scene rough = scene_from(
      "[box]\nwidth = 9\nheight = 9\n[physics]\nroughness = { tangential_restitution = 0.5 }\n" +
      group("0.1", "1", 2, "spin = 7.0") + group("0.1", "1", 3, "spin = [1.0, -2.0, 3.0]") + "[run]\nt_end = 1\n");
  EXPECT_THAT(initial_state(rough).disks.spin, ElementsAre(7.0, 7.0, 1.0, -2.0, 3.0));
}

// For each group the mean of I w^2 is the temperature to the last digits, whatever other groups have.
TEST(Spins, OfAGroupHaveItsTemperature) {
  const State s = initial_state(
      scene_with("[physics]\nroughness = { tangential_restitution = 0.5 }\n" + group("1", "1", 5, "spin = 7.0") +
                 group("{ uniform = [0.1, 0.6] }", "{ uniform = [1, 9] }", 40, "spin_temperature = 2.5")));
  const Disks& d = s.disks;
  double sum = 0.0;
  for (std::size_t i = 5; i < 45; ++i) sum += 0.5 * d.mass[i] * d.radius[i] * d.radius[i] * d.spin[i] * d.spin[i];
  EXPECT_NEAR(sum / 40.0, 2.5, 1e-13);
}

TEST(Sizes, AListHasAnEntryADisk) {
  Scene scene = scene_with(group("[1, 2]", "1", 2));
  scene.groups[0].count = 3;
  std::vector<double> radii, masses;
  EXPECT_THROW(draw_sizes(scene, scene.groups[0], 0, radii, masses), InputError);
}

TEST(InitialState, SameSceneSameBits) {
  const std::string text = group("{ uniform = [0.3, 0.6] }", "1", 300, "velocities = { maxwell = 1 }");
  EXPECT_EQ(state_hash(initial_state(scene_with(text)).disks), state_hash(initial_state(scene_with(text)).disks));
  EXPECT_NE(state_hash(initial_state(scene_with(text)).disks), state_hash(initial_state(scene_with(text, 4)).disks));
}

// The bits themselves are compared: another compiler, another machine or a changed draw would show here.
TEST(InitialState, Golden) {
  const std::string mixed =
      group("{ uniform = [1, 3] }", "{ from_radius = 0.3 }", 200, "velocities = { maxwell = 2 }") +
      group("{ from_mass = 0.7 }", "{ uniform = [1, 9] }", 300, "velocities = { uniform = 2 }");
  EXPECT_EQ(hash_text(state_hash(initial_state(scene_with(mixed)).disks)), "1a51a35fddd27c46");
  const Scene dense =
      scene_from("[box]\npacking_fraction = 0.52\nleft = \"periodic\"\nright = \"periodic\"\n[run]\nt_end = 1\n" +
                 group("0.5", "1", 2000, "velocities = { maxwell = 1 }"));
  EXPECT_EQ(hash_text(state_hash(initial_state(dense).disks)), "d1368b89c7ac6148");
}

void expect_scaled(const std::vector<double>& a, const std::vector<double>& b, double unit) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i] * unit, b[i]) << i;
}

TEST(InitialState, SameBitsInAnyUnits) {
  const std::string groups =
      group("0.5", "2", 3, "velocities = [[1, 0], [0, 1], [1, 1]]") +
      group("{ uniform = [1, 3] }", "{ from_radius = 0.3 }", 200, "velocities = { maxwell = 2 }") +
      group("{ from_mass = 0.7 }", "{ uniform = [1, 9] }", 300, "velocities = { uniform = 2 }") +
      test::replaced(group("0.1", "1", 90), "random", "hexagonal");
  std::string dense = group("0.5", "1", 300);
  dense += "[box]\npacking_fraction = 0.52\nleft = \"periodic\"\nright = \"periodic\"\n[run]\nt_end = 1\n";
  for (const Scene& scene : {scene_with(groups), scene_from(dense)}) {
    const State s = initial_state(scene);
    for (const double a : {0x1p20, 0x1p-20}) {
      for (const Units& u : {Units{a, 1, 1}, Units{1, a, 1}, Units{1, 1, a}, Units{a, 2 * a, 4 / a}}) {
        const State t = initial_state(scaled(scene, u));
        expect_scaled(s.disks.x, t.disks.x, u.length);
        expect_scaled(s.disks.y, t.disks.y, u.length);
        expect_scaled(s.disks.vx, t.disks.vx, u.length / u.time);
        expect_scaled(s.disks.vy, t.disks.vy, u.length / u.time);
        expect_scaled(s.disks.radius, t.disks.radius, u.length);
        expect_scaled(s.disks.mass, t.disks.mass, u.mass);
      }
    }
  }
}

// The box computed from packing_fraction must scale with the radii.
TEST(InitialState, SameBoxInAnyUnits) {
  const auto box = [](double unit) {
    return scene_from(
               fmt::format("[box]\npacking_fraction = 0.3\naspect = 1.7\n[[disks]]\ncount = 20\npositions = "
                           "\"random\"\nradius = {{ uniform = [{:.17g}, {:.17g}] }}\nmass = 1\n[run]\nt_end = 1\n",
                           0.3 * unit, 0.7 * unit))
        .box;
  };
  for (const double unit : {0x1p20, 0x1p-20}) {
    EXPECT_EQ(box(unit).width, unit * box(1).width);
    EXPECT_EQ(box(unit).height, unit * box(1).height);
  }
}

// Only obstacles are wanted: neither must disks be placed that do not affect them, nor must any grow.
TEST(InitialState, HasTheObstaclesThatAreAskedForAlone) {
  const std::string pegs = "[[disks]]\ncount = 2\nfixed = true\nradius = { uniform = [1, 2] }\npositions = ";
  const std::string box = "[box]\nwidth = 40\nheight = 30\n";
  const std::string moving = box + "left = { place = 5, motion = { velocity = [0.1, 0] } }\n";
  const std::string walls = "[[walls]]\nfrom = [20, 20]\nto = [30, 25]\n";
  for (const std::string& room : {box, moving}) {
    for (const std::string fixed : {"[[10, 10], [30, 10]]", "\"square\"", "\"random\""}) {
      for (const std::string others : {"\"random\"", "\"growth\""}) {
        const Scene scene =
            scene_from(room + "[[disks]]\ncount = 40\npositions = " + others + "\nradius = 0.5\nmass = 1\n" + pegs +
                       fixed + "\n" + walls + "[run]\nt_end = 1\n");
        const std::vector<Obstacle> all = initial_state(scene).obstacles;
        const std::vector<Obstacle> alone = obstacles_of(scene);
        ASSERT_EQ(alone.size(), 3U);
        ASSERT_EQ(all.size(), 3U);
        for (std::size_t k = 0; k < all.size(); ++k) {
          SCOPED_TRACE(testing::Message() << fixed << " among " << others << ", obstacle " << k);
          EXPECT_EQ(alone[k].x, all[k].x);
          EXPECT_EQ(alone[k].y, all[k].y);
          EXPECT_EQ(alone[k].radius, all[k].radius);
          EXPECT_EQ(alone[k].id, all[k].id);
          EXPECT_EQ(alone[k].kind, all[k].kind);
        }
      }
    }
  }
  // There are many disks, which would take minutes to grow; so they must not be grown here.
  const Scene many = scene_from(
      "[box]\nwidth = 400\nheight = 400\n[[disks]]\ncount = 160000\npositions = \"growth\"\n"
      "radius = 0.5\nmass = 1\n" +
      pegs + "[[100, 100], [300, 300]]\n[run]\nt_end = 1\n");
  EXPECT_EQ(obstacles_of(many).size(), 2U);
}

// A drift is added to listed velocities, too; and a position at the upper end of a periodic side is put at its lower
// end.
TEST(Positions, GivenOnesDriftAndWrap) {
  const State s = initial_state(
      scene_from("[box]\nwidth = 20\nheight = 10\nleft = \"periodic\"\nright = \"periodic\"\n[[disks]]\ncount = 2\n"
                 "positions = [[20, 5], [10, 5]]\nvelocities = [[1, 2], [3, 4]]\ndrift = [0.5, -1]\nradius = 0.5\n"
                 "mass = 1\n[run]\nmethod = \"exact\"\nt_end = 1\n"));
  EXPECT_THAT(s.disks.x, ElementsAre(0.0, 10.0));
  EXPECT_THAT(s.disks.vx, ElementsAre(1.5, 3.5));
  EXPECT_THAT(s.disks.vy, ElementsAre(1.0, 3.0));
}

}  // namespace
}  // namespace carom
