// Gravity as a vector: parabolas at every side, slopes, piles in corners, and scenes rotated together with gravity.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/physics/advance.hpp"
#include "core/physics/boundary.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/silo.hpp"

namespace carom {
namespace {

constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

struct SceneParts {
  double width = 20.0, height = 20.0;
  std::string sides, physics, rest;
  double dt = 0.005, t_end = 4.0;
};

Scene scene_of(const std::string& method, const SceneParts& p) {
  return parse_scene(fmt::format("[box]\nwidth = {}\nheight = {}\n{}[physics]\n{}\n{}[run]\nmethod = \"{}\"\ndt = {}\n"
                                 "t_end = {}\n",
                                 p.width, p.height, p.sides, p.physics, p.rest, method, p.dt, p.t_end),
                     "tilted.toml", "");
}

State run_to_end(const Scene& scene, State start) {
  const auto engine = make_parallel_engine(scene, std::move(start), {2, 1});
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

State run_to_end(const Scene& scene) {
  return run_to_end(scene, initial_state(scene));
}

std::string one_disk(double x, double y, double vx, double vy, double radius) {
  return fmt::format("[[disks]]\ncount = 1\npositions = [[{}, {}]]\nvelocities = [[{}, {}]]\nradius = {}\nmass = 2.0\n",
                     x, y, vx, vy, radius);
}

double part_of(const Gravity& g, Side side) {
  return outward_acceleration(side, g);
}

TEST(GravityVector, KnowsItsSizeAndItsParts) {
  const Gravity g{3.0, 4.0};
  EXPECT_EQ(g.size, 5.0);
  EXPECT_EQ(g.against(0.6, 0.8), 4.0 * 0.8 + 3.0 * 0.6);
  EXPECT_EQ(part_of(g, Side::left), 3.0);
  EXPECT_EQ(part_of(g, Side::right), -3.0);
  EXPECT_EQ(part_of(g, Side::bottom), 4.0);
  EXPECT_EQ(part_of(g, Side::top), -4.0);
  EXPECT_EQ(Gravity(-0.1, 0.0).size, 0.1);
  EXPECT_EQ(Gravity(0.0, -0.7).size, 0.7);
  EXPECT_EQ(Gravity(1e200, 1e-200).size, 1e200);
  EXPECT_EQ(Gravity(1e-200, 0.0).size, 1e-200);
  EXPECT_FALSE(Gravity().acts());
  EXPECT_FALSE(Gravity(0.5).is_tilted());
}

// The coordinate of a free disk on its parabola and on those after its bounces; each axis is independent.
double bouncing(double c, double v, double g, double low, double t) {
  for (;;) {
    const double landing = (v + std::sqrt(v * v + 2.0 * g * (c - low))) / g;
    if (landing > t) return c + v * t - 0.5 * g * t * t;
    t -= landing;
    v = -(v - g * landing);
    c = low;
  }
}

TEST(GravityVector, AFreeDiskIsOnParabolasAlongBothAxes) {
  const double gx = 1.0, gy = 0.5;
  for (const char* method : methods) {
    SceneParts p;
    p.physics = fmt::format("gravity = [{}, {}]", -gx, -gy);
    p.rest = one_disk(12.0, 9.0, 1.5, -0.25, 0.5);
    p.t_end = 25.0;
    const Scene scene = scene_of(method, p);
    const State end = run_to_end(scene);
    EXPECT_GT(end.counters.wall_collisions, 3U);
    const double allowed = scene.run.method == Method::exact ? 1e-10 : 0.05;
    EXPECT_NEAR(end.disks.x[0], bouncing(12.0, 1.5, gx, 0.5, 25.0), allowed) << method;
    EXPECT_NEAR(end.disks.y[0], bouncing(9.0, -0.25, gy, 0.5, 25.0), allowed) << method;
  }
}

// An inclined frame, in its own coordinates: a disk on the floor slides along it.
TEST(GravityVector, ADiskSlidesDownAnInclinedFrame) {
  SceneParts p;
  p.sides = "wall_restitution = 0.0\n";
  p.physics = "gravity = [0.5, -1.0]";
  p.rest = one_disk(2.0, 0.5, 0.0, 0.0, 0.5);
  const State end = run_to_end(scene_of("pairwise", p));
  EXPECT_NEAR(end.disks.x[0], 2.0 + 0.5 * 0.5 * 16.0, 1e-12);
  EXPECT_NEAR(end.disks.vx[0], 2.0, 1e-12);
  EXPECT_NEAR(end.disks.y[0], 0.5, 1e-9);
}

// Disks rest on ceilings, too, and on the right, if gravity pulls up or to the right.
TEST(GravityVector, ADiskRestsOnAnySide) {
  const std::pair<const char*, Side> cases[] = {
      {"[-1, 0]", Side::left}, {"[1, 0]", Side::right}, {"[0, -1]", Side::bottom}, {"[0, 1]", Side::top}};
  for (const auto& [gravity, side] : cases) {
    SceneParts p;
    p.sides = "wall_restitution = 0.3\n";
    p.physics = std::string("gravity = ") + gravity;
    p.rest = one_disk(10.0, 10.0, 0.0, 0.0, 0.5);
    p.t_end = 30.0;
    const Scene scene = scene_of("pairwise", p);
    const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
    while (engine->state().time < 20.0) engine->step();
    const State middle = engine->state();
    while (engine->state().time < scene.run.t_end) engine->step();
    const State& end = engine->state();
    const Disks& d = end.disks;
    EXPECT_NEAR(reach_beyond(side, d.x[0], d.y[0], 0.5, scene.box), 0.0, 1e-4) << gravity;
    EXPECT_LT(std::hypot(d.vx[0], d.vy[0]), 1e-2) << gravity;
    const auto force = test::mean_forces(middle.counters, end.counters, end.time - middle.time);
    for (const Side s : all_sides) EXPECT_NEAR(force[static_cast<std::size_t>(s)], s == side ? 2.0 : 0.0, 0.01);
  }
}

// A disk slides down an inner wall, from rest, with the component of g along it.
TEST(GravityVector, ADiskSlidesDownAChute) {
  const double length = std::sqrt(16.0 * 16.0 + 8.0 * 8.0);
  const Vec2 along{16.0 / length, -8.0 / length}, off{8.0 / length, 16.0 / length};
  const Vec2 start{4.0 + 0.5 * off.x, 12.0 - 1.0 + 0.5 * off.y};
  SceneParts p;
  p.physics = "gravity = [0.3, -1.0]";
  p.rest = "[[walls]]\nfrom = [2.0, 12.0]\nto = [18.0, 4.0]\nrestitution = 0.0\n" +
           one_disk(start.x, start.y, 0.0, 0.0, 0.5);
  p.t_end = 4.0;
  const double pull = 0.3 * along.x - 1.0 * along.y;
  const State end = run_to_end(scene_of("pairwise", p));
  const Vec2 gone{end.disks.x[0] - start.x, end.disks.y[0] - start.y};
  EXPECT_NEAR(gone.x * along.x + gone.y * along.y, 0.5 * pull * 16.0, 1e-6);
  EXPECT_NEAR(gone.x * off.x + gone.y * off.y, 0.0, 1e-3);
  EXPECT_NEAR(end.disks.vx[0] * along.x + end.disks.vy[0] * along.y, pull * 4.0, 1e-6);
}

const std::string gas =
    "[[disks]]\ncount = 60\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = { uniform = [0.2, 0.6] }\n"
    "mass = { uniform = [1, 5] }\n";
const std::string obstacles =
    "[[disks]]\nfixed = true\ncount = 6\npositions = \"random\"\nradius = { uniform = [0.1, 0.7] }\n"
    "[[walls]]\npoints = [[3.0, 4.0], [8.0, 6.0], [7.0, 11.0]]\n[[walls]]\nfrom = [16.0, 3.0]\nto = [11.0, 15.0]\n";

// Elastic disks: the energy is conserved, including the work against gravity along both axes.
TEST(GravityVector, ExactKeepsTheEnergyAmongObstacles) {
  for (const char* gravity : {"[-0.4, -0.3]", "[0.5, 0]", "[0.2, 0.6]"}) {
    SceneParts p;
    p.physics = std::string("gravity = ") + gravity;
    p.rest = gas + obstacles;
    p.t_end = 30.0;
    const Scene scene = scene_of("exact", p);
    const State start = initial_state(scene);
    const State end = run_to_end(scene, start);
    const Energy before = energy_of(start.disks, scene.physics.gravity);
    const Energy after = energy_of(end.disks, scene.physics.gravity);
    EXPECT_GT(end.counters.wall_collisions, 500U);
    EXPECT_GT(std::abs(after.potential - before.potential), 1.0) << "the test needs work against gravity";
    const double scale = before.kinetic + std::abs(before.potential);
    EXPECT_NEAR(after.total(), before.total(), 1e-10 * scale) << gravity;
    EXPECT_LT(wall_overlap(end.disks, scene.box), 1e-12);
  }
}

// The force on the sides is the weight plus the change of momentum, to rounding, in every method.
TEST(GravityVector, ForcesOnTheWallsBalance) {
  for (const char* method : methods) {
    SceneParts p;
    p.physics = "gravity = [-0.3, -0.4]\nrestitution = 0.95";
    p.rest = gas;
    p.t_end = 10.0;
    const Scene scene = scene_of(method, p);
    const State start = initial_state(scene);
    const State end = test::run(scene, start);
    const Momentum before = momentum_of(start.disks), after = momentum_of(end.disks);
    double mass = 0.0;
    for (std::size_t i = 0; i < start.disks.size(); ++i) mass += start.disks.mass_of(i);
    const double* impulse = end.counters.wall_impulse;
    const double scale = impulse[0] + impulse[1] + impulse[2] + impulse[3];
    EXPECT_NEAR((impulse[0] - impulse[1] - mass * 0.3 * end.time - (after.x - before.x)) / scale, 0.0, 1e-12) << method;
    EXPECT_NEAR((impulse[2] - impulse[3] - mass * 0.4 * end.time - (after.y - before.y)) / scale, 0.0, 1e-12) << method;
  }
}

// A pile at rest in a corner: the left side and the floor bear their components of the weight.
TEST(GravityVector, APileRestsInACorner) {
  SceneParts p;
  p.width = p.height = 12.0;
  p.sides = "wall_restitution = 0.5\n";
  p.physics = "gravity = [-0.6, -0.8]\nrestitution = 0.5";
  p.rest =
      "[[disks]]\ncount = 60\npositions = \"random\"\nradius = { uniform = [0.4, 0.6] }\nmass = { from_radius = 1 }\n";
  p.t_end = 120.0;
  const Scene scene = scene_of("pairwise", p);
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
  while (engine->state().time < 100.0) engine->step();
  const State middle = engine->state();
  while (engine->state().time < scene.run.t_end) engine->step();
  const State& end = engine->state();
  const auto force = test::mean_forces(middle.counters, end.counters, end.time - middle.time);
  const double weight = test::weight_of(end.disks, 1.0);
  const double left = force[static_cast<std::size_t>(Side::left)] - force[static_cast<std::size_t>(Side::right)];
  const double floor = force[static_cast<std::size_t>(Side::bottom)] - force[static_cast<std::size_t>(Side::top)];
  EXPECT_NEAR(left / (0.6 * weight), 1.0, 0.01);
  EXPECT_NEAR(floor / (0.8 * weight), 1.0, 0.01);
  EXPECT_LT(energy_of(end.disks, scene.physics.gravity).kinetic,
            1e-4 * energy_of(end.disks, scene.physics.gravity).total());
  EXPECT_LT(max_overlap(end.disks, scene.box), 0.02);
}

// Exchanges x and y of the box, the disks, the obstacles, and gravity. Every formula is symmetric, operation by
// operation.
Scene exchanged(Scene s) {
  std::swap(s.box.width, s.box.height);
  const auto swap_sides = [](auto& of_side) {
    std::swap(of_side[0], of_side[2]);
    std::swap(of_side[1], of_side[3]);
  };
  swap_sides(s.box.sides);
  swap_sides(s.box.restitutions);
  swap_sides(s.box.motions);
  swap_sides(s.box.places);
  s.physics.gravity = {s.physics.gravity.down, s.physics.gravity.left};
  for (InnerWall& wall : s.walls) {
    for (Vec2& point : wall.points) std::swap(point.x, point.y);
  }
  return s;
}

State exchanged(State s) {
  std::swap(s.disks.x, s.disks.y);
  std::swap(s.disks.vx, s.disks.vy);
  for (Obstacle& o : s.obstacles) {
    std::swap(o.x, o.y);
    std::swap(o.dx, o.dy);
  }
  return s;
}

struct Exchange {
  const char* name;
  std::string sides, physics, rest;
};

TEST(GravityVector, WhatIsTrueDownwardsIsTrueToTheLeftBitForBit) {
  const Exchange cases[] = {
      {"walls", "wall_restitution = 0.9\n", "gravity = 0.7\nrestitution = 0.9", gas},
      {"obstacles", "", "gravity = 0.7", gas + obstacles},
      {"periodic", "bottom = \"periodic\"\ntop = \"periodic\"\n", "gravity = 0.4", gas},
      {"channel", "left = \"periodic\"\nright = \"periodic\"\n", "gravity = [0.1, -0.6]", gas},
      {"shaken", "bottom = { motion = { vibrate = [0, 0.4], period = 1.1 } }\n", "gravity = 0.5", gas},
      {"upwards", "", "gravity = [0, 0.6]", gas + obstacles},
      {"tilted", "", "gravity = [-0.5, -0.6]", gas + obstacles}};
  for (const Exchange& c : cases) {
    for (const char* method : methods) {
      SCOPED_TRACE(fmt::format("{} by {}", c.name, method));
      SceneParts p;
      p.height = 17.0;
      p.sides = c.sides;
      p.physics = c.physics;
      p.rest = c.rest;
      const Scene scene = scene_of(method, p);
      const State start = initial_state(scene);
      const State end = test::run(scene, start);
      const State other = test::run(exchanged(scene), exchanged(start));
      EXPECT_GT(end.counters.collisions, 30U);
      EXPECT_EQ(end.counters.collisions, other.counters.collisions);
      EXPECT_EQ(end.counters.wall_collisions, other.counters.wall_collisions);
      EXPECT_EQ(end.disks.x, other.disks.y);
      EXPECT_EQ(end.disks.y, other.disks.x);
      EXPECT_EQ(end.disks.vx, other.disks.vy);
      EXPECT_EQ(end.disks.vy, other.disks.vx);
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(end.counters.wall_impulse[k], other.counters.wall_impulse[(k + 2) % 4]);
      }
    }
  }
}

// If sides are periodic along gravity and there are no obstacles, disks fall for ever: relative to each other they move
// as without gravity, with the same collisions and warnings. No contact bears load, however slow it is.
TEST(GravityVector, IsNotFeltByDisksThatFallForEver) {
  const std::string cooling =
      "[[disks]]\ncount = 100\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0\n";
  const std::string along_x = "left = \"periodic\"\nright = \"periodic\"\n";
  struct Case {
    std::string sides, gravity;
  };
  for (const Case& c : {Case{along_x + "bottom = \"periodic\"\ntop = \"periodic\"\n", "[0.6, -0.8]"},
                        Case{along_x + "wall_restitution = 0.9\n", "[1.0, 0.0]"}}) {
    for (const char* method : methods) {
      SCOPED_TRACE(c.gravity + " by " + method);
      SceneParts p;
      p.width = p.height = 14.0;
      p.sides = c.sides;
      p.rest = cooling;
      p.dt = 0.04;
      p.t_end = 2.0;
      p.physics = "restitution = 0.9";
      const Scene free = scene_of(method, p);
      p.physics = "restitution = 0.9\ngravity = " + c.gravity;
      const Scene falling = scene_of(method, p);
      const auto one = make_parallel_engine(free, initial_state(free), {2, 1});
      const auto other = make_parallel_engine(falling, initial_state(falling), {2, 1});
      while (one->state().time < 2.0) one->step();
      while (other->state().time < 2.0) other->step();
      const State &a = one->state(), &b = other->state();
      EXPECT_GT(a.counters.collisions, 200U);
      EXPECT_EQ(a.counters.collisions, b.counters.collisions);
      EXPECT_EQ(a.counters.wall_collisions, b.counters.wall_collisions);
      const std::vector<std::size_t> order_a = by_id(a.disks), order_b = by_id(b.disks);
      for (std::size_t k = 0; k < order_a.size(); ++k) {
        const std::size_t i = order_a[k], j = order_b[k];
        EXPECT_NEAR(a.disks.vx[i], b.disks.vx[j] + 2.0 * falling.physics.gravity.left, 1e-6) << k;
        EXPECT_NEAR(a.disks.vy[i], b.disks.vy[j] + 2.0 * falling.physics.gravity.down, 1e-6) << k;
      }
      EXPECT_EQ(one->take_warnings().size(), other->take_warnings().size());
    }
  }
}

// A vector that points down has the bits of the single number.
TEST(GravityVector, StraightDownHasTheBitsOfTheNumber) {
  for (const char* method : methods) {
    SceneParts p;
    p.rest = gas + obstacles;
    p.physics = "gravity = 0.7";
    const State number = run_to_end(scene_of(method, p));
    p.physics = "gravity = [0.0, -0.7]";
    const State vector = run_to_end(scene_of(method, p));
    EXPECT_EQ(state_hash(number.disks), state_hash(vector.disks)) << method;
  }
}

// Side walls that absorb all speed leave velocities of -0; drifting back, as rollback does, must not make them +0.
TEST(GravityVector, KeepsTheSignOfAZero) {
  double x = 1.0, y = 1.0, vx = -0.0, vy = 1.0;
  drift<true>(x, y, vx, vy, -0.5, Gravity(2.0));
  EXPECT_TRUE(std::signbit(vx));
  drift<true>(x, y, vx, vy, 0.5, Gravity(2.0));
  EXPECT_TRUE(std::signbit(vx));
  SceneParts p;
  p.sides = "wall_restitution = 0\n";
  p.rest = gas;
  p.dt = 0.02;
  p.t_end = 8.0;
  for (const char* gravity : {"gravity = 0.7", "gravity = [-0.7, 0.0]"}) {
    p.physics = gravity;
    const Scene scene = scene_of("rollback", p);
    const State end = run_to_end(scene);
    EXPECT_GT(end.counters.wall_collisions, 30U);
    EXPECT_EQ(state_hash(end.disks), state_hash(test::run(scene, initial_state(scene)).disks)) << gravity;
  }
}

}  // namespace
}  // namespace carom
