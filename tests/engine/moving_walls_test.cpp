// Moving inner walls: times of contacts, work and momentum; the same results in a moving frame, and with a side that
// moves in the same way; the same bits from both engines and from any state on; scenes that are refused, and disks that
// are crushed.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/check.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/energy_gain.hpp"
#include "core/measure/invariants.hpp"
#include "core/physics/obstacle_path.hpp"
#include "core/scene/scene_text.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/engine_run.hpp"

namespace carom {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

Scene scene_with(const std::string& sides, const std::string& rest, const std::string& method, double t_end,
                 double dt = 0.001) {
  return parse_scene(
      fmt::format("[box]\nwidth = 20.0\nheight = 20.0\n{}\n{}[run]\nmethod = \"{}\"\ndt = {}\nt_end = {}\n", sides,
                  rest, method, dt, t_end),
      "moving.toml", "");
}

std::string wall(const std::string& points, const std::string& motion) {
  return fmt::format("[[walls]]\npoints = {}\n{}\n", points, motion.empty() ? "" : "motion = { " + motion + " }");
}

std::string one_disk(double x, double y, double vx, double vy, double radius) {
  return fmt::format("[[disks]]\ncount = 1\npositions = [[{}, {}]]\nvelocities = [[{}, {}]]\nradius = {}\nmass = 2.0\n",
                     x, y, vx, vy, radius);
}

std::string gas(int count, double radius, const std::string& more = "") {
  return fmt::format(
      "[[disks]]\ncount = {}\npositions = \"random\"\nvelocities = {{ maxwell = 1.0 }}\nradius = {}\nmass "
      "= 1.5\n{}",
      count, radius, more);
}

// At 1.5, 4.625 and 6.5 the disk bounces off the paddle, the side, and the paddle again.
TEST(MovingWall, IsAPaddle) {
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const Scene scene =
        scene_with("", wall("[[5, 2], [5, 18]]", "velocity = [1, 0]") + one_disk(10, 10, -2, 0.25, 0.5), method, 7.0);
    const State end = test::run_by_engine(scene, initial_state(scene));
    EXPECT_NEAR(end.disks.vx[0], 6.0, 1e-12);
    EXPECT_NEAR(end.disks.x[0], 15.0, 1e-11);
    EXPECT_EQ(end.disks.vy[0], 0.25);
    EXPECT_EQ(end.counters.wall_collisions, 3U);
    EXPECT_NEAR(end.counters.wall_work, 32.0, 1e-11);
    EXPECT_NEAR(end.counters.wall_push[0], 32.0, 1e-11);
    EXPECT_EQ(end.counters.wall_push[1], 0.0);
    EXPECT_TRUE(energy_warnings(scene, run_start(initial_state(scene), scene), end).empty())
        << "the work of walls must not count as an unexplained gain";
  }
}

// A disk meets the end of a wall, half a radius beside it: at rest, and the same in a moving frame.
TEST(MovingWall, HasRoundEnds) {
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const Scene scene =
        scene_with("", wall("[[10, 10], [10, 2]]", "velocity = [-0.5, 0.75]") + one_disk(5, 10.5, 2.0 - 0.5, 0.75, 1.0),
                   method, 3.5);
    const State end = test::run_by_engine(scene, initial_state(scene));
    EXPECT_NEAR(end.disks.vx[0], -1.0 - 0.5, 1e-12);
    EXPECT_NEAR(end.disks.vy[0], std::sqrt(3.0) + 0.75, 1e-12);
    const double gained = 1.5 * 1.5 + 2.4820508075688772 * 2.4820508075688772 - 1.5 * 1.5 - 0.75 * 0.75;
    EXPECT_NEAR(end.counters.wall_work, gained, 1e-11);
  }
}

// A gas and walls that drift together, more than once around a periodic box, compared with the same at rest.
TEST(MovingWall, IsOneAtRestInAFrameThatMovesAlong) {
  const std::string sides = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"";
  const auto scene_at = [&](const char* method, double vx, double vy) {
    const std::string motion = vx != 0.0 ? fmt::format("velocity = [{}, {}]", vx, vy) : "";
    const std::string drift = vx != 0.0 ? fmt::format("drift = [{}, {}]\n", vx, vy) : "";
    return scene_with(
        sides, wall("[[3, 4], [9, 8], [4, 14]]", motion) + wall("[[14, 2], [19, 17]]", motion) + gas(12, 0.6, drift),
        method, 4.0, 0.0005);
  };
  for (const char* method : {"exact", "pairwise"}) {
    SCOPED_TRACE(method);
    const Scene still = scene_at(method, 0.0, 0.0);
    const Scene drifting = scene_at(method, 6.5, -8.0);
    const State a = test::run_by_engine(still, initial_state(still));
    const State b = test::run_by_engine(drifting, initial_state(drifting));
    EXPECT_EQ(a.counters.collisions, b.counters.collisions);
    EXPECT_EQ(a.counters.wall_collisions, b.counters.wall_collisions);
    EXPECT_GT(a.counters.wall_collisions, 3U);
    if (std::string(method) == "pairwise") continue;  // its steps are split because of the higher speed
    for (std::size_t i = 0; i < a.disks.size(); ++i) {
      const Vec2 apart = nearest_image({std::fmod(a.disks.x[i] + 26.0 - b.disks.x[i], 20.0),
                                        std::fmod(a.disks.y[i] - 32.0 + 40.0 - b.disks.y[i], 20.0)},
                                       still.box);
      EXPECT_NEAR(apart.x, 0.0, 1e-8);
      EXPECT_NEAR(apart.y, 0.0, 1e-8);
      EXPECT_NEAR(a.disks.vx[i] + 6.5, b.disks.vx[i], 1e-8);
    }
  }
}

// A vibrating floor, as a side and as an inner wall at the same place.
TEST(MovingWall, IsAFloorThatVibrates) {
  for (const char* method : {"exact", "pairwise"}) {
    for (const char* shape : {"parabola", "sine"}) {
      SCOPED_TRACE(std::string(method) + shape);
      const std::string motion = fmt::format("vibrate = [0, 0.3], period = 1.7, shape = \"{}\"", shape);
      const std::string rest = "[physics]\ngravity = 1.0\n";
      const std::string ball = one_disk(10, 2, 0.5, 0, 0.5);
      const Scene side = scene_with("bottom = { motion = { " + motion + " } }", rest + ball, method, 12.0);
      const Scene inner = scene_with("", rest + wall("[[0, 0.3], [20, 0.3]]", motion) + ball, method, 12.0);
      const State a = test::run_by_engine(side, initial_state(side));
      const State b = test::run_by_engine(inner, initial_state(inner));
      EXPECT_GT(a.counters.wall_collisions, 1U);
      EXPECT_EQ(a.counters.wall_collisions, b.counters.wall_collisions);
      EXPECT_NEAR(a.disks.y[0], b.disks.y[0], 1e-9);
      EXPECT_NEAR(a.disks.vy[0], b.disks.vy[0], 1e-9);
      EXPECT_NEAR(a.counters.side_energy[2], b.counters.wall_work, 1e-9);
    }
  }
}

// Polylines and single segments in a gas, with all kinds of motion.
std::string stirrers() {
  return wall("[[3, 4], [6, 8], [4, 12]]", "velocity = [0.4, 0.1]") +
         wall("[[12, 3], [15, 6]]", "vibrate = [0.8, -0.5], period = 1.3") +
         wall("[[10, 14], [16, 16]]", "vibrate = [-0.3, 0.7], period = 0.9, shape = \"sine\"") +
         wall("[[2, 16], [6, 18]]", "");
}

// Elastic disks: the energy gained is the work, and the momentum gained is that from sides and walls.
TEST(LongMovingWall, DoesTheWorkThatIsGained) {
  for (const char* method : methods) {
    for (const std::string physics : {"", "[physics]\ngravity = [0.1, -0.3]\n"}) {
      SCOPED_TRACE(std::string(method) + physics);
      const Scene scene = scene_with("", physics + stirrers() + gas(60, 0.3), method, 12.0);
      const bool exact = scene.run.method == Method::exact;
      const State start = initial_state(scene);
      double deepest = 0.0;
      const State end = test::run_by_engine(scene, start, [&](const State& s) {
        Domain box = box_at(scene.box, s.time);
        const auto cells = place_obstacles(s.obstacles, box, motions_of(scene));
        deepest = std::max(deepest, wall_overlap(s.disks, box));
      });
      const double after = energy_of(end.disks, scene.physics.gravity).total();
      const double given = energy_of(start.disks, scene.physics.gravity).total();
      EXPECT_GT(end.counters.wall_work, 0.1 * given);
      const double allowed = exact || physics.empty() ? 1e-12 : 1e-2;  // stepping under gravity is only of first order
      EXPECT_NEAR(given + end.counters.wall_work, after, allowed * after);
      EXPECT_LE(deepest, exact ? 1e-11 : 0.25);
    }
  }
}

// In a box with periodic sides and no other obstacles all momentum comes from the moving walls.
TEST(MovingWall, GivesTheMomentumThatIsGained) {
  const std::string sides = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"";
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const Scene scene = scene_with(sides,
                                   wall("[[3, 4], [6, 8]]", "velocity = [3, 1]") +
                                       wall("[[12, 3], [15, 6]]", "vibrate = [2, 0.5], period = 1.3") + gas(50, 0.3),
                                   method, 20.0);
    const State start = initial_state(scene);
    const State end = test::run_by_engine(scene, start);
    const Momentum before = momentum_of(start.disks);
    const Momentum after = momentum_of(end.disks);
    EXPECT_GT(std::abs(after.x - before.x), 1.0);
    EXPECT_NEAR(after.x - before.x, end.counters.wall_push[0], 1e-11 * after.magnitude);
    EXPECT_NEAR(after.y - before.y, end.counters.wall_push[1], 1e-11 * after.magnitude);
  }
}

// Rough disks: friction acts in the wall's frame, and the work is that of the whole force.
TEST(MovingWall, RubsInItsFrame) {
  for (const char* method : {"exact", "pairwise"}) {
    SCOPED_TRACE(method);
    const std::string rough = "[physics]\nroughness = { tangential_restitution = 1.0 }\n";
    const Scene scene =
        scene_with("wall_roughness = { tangential_restitution = 1.0 }",
                   rough + wall("[[2, 4], [2, 16]]", "velocity = [0.2, 0.1]") + gas(30, 0.5), method, 10.0);
    const State start = initial_state(scene);
    const State end = test::run_by_engine(scene, start);
    const double given = energy_of(start.disks, 0.0).total();
    EXPECT_GT(std::abs(end.counters.wall_work), 0.01 * given);
    EXPECT_NEAR(given + end.counters.wall_work, energy_of(end.disks, 0.0).total(), 1e-11 * given);
  }
}

// A lift: the disk comes to rest on it, and the work is the weight times the height.
TEST(MovingWall, BearsWhatItLifts) {
  const Scene scene = scene_with("",
                                 "[physics]\ngravity = 2.0\nrestitution = 0.3\n" +
                                     wall("[[4, 1], [16, 1]]", "velocity = [0, 0.5]") + one_disk(10, 2, 0, 0, 0.5),
                                 "pairwise", 12.0);
  Scene soft = scene;
  soft.walls[0].restitution = 0.3;
  double halfway = 0.0;
  const State end = test::run_by_engine(soft, initial_state(soft), [&](const State& s) {
    if (s.time <= 8.0) halfway = s.counters.wall_work;
  });
  EXPECT_NEAR(end.disks.y[0], 7.5, 1e-3);
  EXPECT_NEAR(end.disks.vy[0], 0.5, 1e-9);
  EXPECT_NEAR(end.counters.wall_work - halfway, 2.0 * 2.0 * 0.5 * (end.time - 8.0), 0.01);
}

std::string hashes(Engine& engine, double t_end) {
  std::string all;
  while (engine.state().time < t_end) {
    engine.step();
    const Counters& c = engine.state().counters;
    all += fmt::format("{} {} {} {} {}\n", hash_text(state_hash(engine.state().disks)), c.wall_collisions, c.wall_work,
                       c.wall_push[0], c.wall_push[1]);
  }
  return all;
}

// The comparison is made after each step, on any number of threads, and with runs that go on from any of these states.
TEST(LongMovingWall, HasTheSameBitsInBothEnginesAndFromAnyState) {
  const std::string sides = "left = \"periodic\"\nright = \"periodic\"\ntop = { motion = { velocity = [0, -0.1] } }";
  for (const char* method : methods) {
    for (const std::string physics : {"",
                                      "[physics]\ngravity = 0.5\nrestitution = 0.9\ncollapse = { model = \"tc\", "
                                      "contact_time = 1e-4 }\n"}) {
      SCOPED_TRACE(std::string(method) + physics);
      const bool tc = !physics.empty() && std::string(method) != "exact";
      const std::string stated = tc ? "[physics]\ngravity = 0.5\nrestitution = 0.9\n" : physics;
      const Scene scene = scene_with(sides, stated + stirrers() + gas(300, 0.2), method, 3.0, 0.01);
      const State start = initial_state(scene);
      const auto reference = make_reference_engine(scene, start);
      const std::string expected = hashes(*reference, scene.run.t_end);
      for (const int threads : {1, 3}) {
        const auto engine = make_parallel_engine(scene, start, {threads, 64});
        EXPECT_TRUE(expected == hashes(*engine, scene.run.t_end)) << threads << " threads";
      }
      const auto first = make_parallel_engine(scene, start, {2, 1});
      while (first->state().time < 1.2) first->step();
      const auto second = make_parallel_engine(scene, first->state(), {1, 1});
      const std::string rest = hashes(*second, scene.run.t_end);
      EXPECT_GT(rest.size(), 100U);
      EXPECT_TRUE(expected.ends_with(rest)) << "resumed";
    }
  }
}

// Every contact predicted is the first one: before it the path overlaps no wall, and at it the disk touches one.
TEST(MovingWall, IsMetAtTheFirstContact) {
  const Scene scene = scene_with("left = \"periodic\"\nright = \"periodic\"",
                                 stirrers() + wall("[[17, 4], [19, 9]]", "velocity = [2.5, 0]") +
                                     wall("[[8, 10], [9, 10]]", "vibrate = [0, 0.9], period = 0.4, shape = \"sine\"") +
                                     one_disk(10, 10, 0, 0, 0.3),
                                 "exact", 20.0);
  Domain box = scene.box;
  box.move_walls(0.325);
  const auto cells = place_obstacles(initial_state(scene).obstacles, box, motions_of(scene));
  constexpr double length = 0.125;  // length of the window: within one piece of each parabola
  cells->follow(0.325, 0.325 + length);
  const auto deepest = [&](const PathSegment& at, double s) {
    const Domain then = box_at(box, 0.325 + s);
    double beyond = -HUGE_VAL;
    for (std::size_t k = 0; k < cells->size(); ++k) {
      beyond = std::max(beyond, gap_to((*cells)[k], wrap(at.x, 20.0), at.y, 0.3, then).beyond);
    }
    return beyond;
  };
  int met = 0;
  for (int k = 0; k < 4000; ++k) {
    const auto fraction = [&](double step) { return std::fmod(step * (k + 1), 1.0); };
    const PathSegment p{0.01 * fraction(0.37), 20.0 * fraction(0.7548776662), 1.0 + 18.0 * fraction(0.5698402910),
                        60.0 * fraction(0.618) - 30.0, 60.0 * fraction(0.4142) - 30.0};
    const Gravity g = k % 2 == 0 ? Gravity(0.0) : Gravity(3.0, 20.0);
    if (deepest(p, p.start) > -1e-6) continue;
    const ObstacleContact first = first_obstacle_contact(p, 0.3, box, g, length);
    const double end = std::min(first.time, length);
    for (int part = 0; part < 200; ++part) {
      const double s = p.start + (end - p.start) * part / 200.0;
      ASSERT_LT(deepest(carried_to(p, s, g), s), 1e-9) << k << " at " << s << " before " << end;
    }
    if (first.time == never) continue;
    ++met;
    ASSERT_NEAR(deepest(carried_to(p, end, g), end), 0.0, 1e-9) << k;
  }
  EXPECT_GT(met, 400);
}

TEST(MovingWall, MayBeASink) {
  for (const char* method : methods) {
    const Scene scene =
        scene_with("", wall("[[2, 0], [2, 20]]", "velocity = [1, 0]") + one_disk(10, 10, 0, 0, 0.5), method, 8.0);
    Scene sink = scene;
    sink.walls[0].sink = true;
    EXPECT_EQ(test::run_by_engine(sink, initial_state(sink)).counters.removed, 1U) << method;
    EXPECT_NEAR(test::run_by_engine(scene, initial_state(scene)).disks.vx[0], 2.0, 1e-12) << method;
  }
}

// A thin wall that moves fast in a long step: the step is split, so that the wall jumps over no disk.
TEST(MovingWall, JumpsOverNoDisk) {
  for (const char* method : {"pairwise", "rollback"}) {
    const Scene scene =
        scene_with("", wall("[[1, 0], [1, 20]]", "velocity = [10, 0]") + one_disk(5, 10, 0, 0, 0.2), method, 0.6, 0.2);
    EXPECT_NEAR(test::run_by_engine(scene, initial_state(scene)).disks.vx[0], 20.0, 1e-9) << method;
  }
}

TEST(LongMovingWall, StopsWhereItWouldCrushADisk) {
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const Scene scene = scene_with("", wall("[[8, 0], [8, 20]]", "velocity = [1, 0]") + one_disk(14, 10, 0.5, 0, 1),
                                   method, 11.9, 0.0005);
    const auto engine = make_parallel_engine(scene, initial_state(scene), {2, 1});
    std::string error;
    try {
      while (engine->state().time < scene.run.t_end) engine->step();
    } catch (const PhysicsError& e) {
      error = e.what();
    }
    EXPECT_THAT(error, AllOf(HasSubstr("a moving wall"), HasSubstr("wall walls.0 has moved by ("))) << error;
    EXPECT_LT(engine->state().time, 10.6);
    EXPECT_GT(engine->state().time, 9.5);
  }
}

TEST(MovingWall, GoesThroughTheTextOfAScene) {
  const Scene scene = scene_with("", stirrers() + gas(5, 0.3), "exact", 5.0);
  const Scene again = parse_scene(resolved_toml(scene), "again", "");
  ASSERT_EQ(again.walls.size(), scene.walls.size());
  for (std::size_t k = 0; k < scene.walls.size(); ++k) EXPECT_EQ(again.walls[k].motion, scene.walls[k].motion) << k;
  EXPECT_TRUE(again.box.inner_walls_move);
}

// If this hash changes the physics has changed: see golden_hash_test.
TEST(MovingWall, HasTheBitsThatItHad) {
  const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/paddle.toml", {{"run.t_end", "10.0"}});
  const State end = test::run_by_engine(scene, initial_state(scene));
  EXPECT_EQ(hash_text(state_hash(end.disks)), "2c6075fbc162ca0c");
  EXPECT_NEAR(end.counters.wall_work, 2.0 * end.counters.wall_push[0], 1e-10);
}

std::string refusal(const std::string& sides, const std::string& rest, double t_end) {
  try {
    scene_with(sides, rest, "exact", t_end);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(BadWallMotion, IsRefusedInOneLine) {
  const std::string ball = one_disk(10, 10, 1, 0, 0.5);
  const auto with = [&](const std::string& motion) { return wall("[[5, 2], [5, 18]]", motion) + ball; };
  EXPECT_EQ(refusal("", with("velocity = [1, 0]"), 14.9), "");
  EXPECT_EQ(refusal("", with("velocity = [1, 0]"), 16.0),
            "moving.toml:7: walls.0.motion: brings the wall to x = 21, beyond the right side, before run.t_end = 16; "
            "expected a wall that stays in the box");
  EXPECT_EQ(refusal("left = \"periodic\"\nright = \"periodic\"", with("velocity = [1, 0]"), 160.0), "");
  EXPECT_THAT(refusal("", with("vibrate = [0, 3], period = 1"), 9.0),
              HasSubstr("brings the wall to y = -1, beyond the bottom side"));
  EXPECT_THAT(refusal("", with("velocity = [0, 0]"), 9.0), HasSubstr("walls.0.motion.velocity: is [0, 0]"));
  EXPECT_THAT(refusal("", with("velocity = [1]"), 9.0), HasSubstr("has 1 number"));
  EXPECT_THAT(refusal("", with("vibrate = [1, 0]"), 9.0), HasSubstr("walls.0.motion.period: missing"));
  EXPECT_THAT(refusal("", with("velocity = [1, 0], vibrate = [1, 0]"), 9.0),
              HasSubstr("has both velocity and vibrate"));
  EXPECT_THAT(refusal("", "[physics]\ndiffusion = 0.1\n" + with("velocity = [1, 0]"), 9.0),
              HasSubstr("walls.0.motion: cannot be used with physics.diffusion"));
  EXPECT_THAT(refusal("left = { motion = { velocity = [1, 0] } }", with("vibrate = [1, 0], period = 2"), 9.0),
              HasSubstr("walls.0.motion: the left side enters the path of this wall at t = 4; expected paths"));
  const std::string floor = "bottom = { motion = { vibrate = [0, 0.5], period = 2 } }";
  const auto above = [&](const std::string& motion) { return wall("[[3, 0.6], [7, 0.6]]", motion) + ball; };
  const auto overlap = HasSubstr(
      "the bottom side enters the path of this wall at t = 0; expected paths of the two that do not overlap until "
      "run.t_end = 9");
  EXPECT_THAT(refusal(floor, above("vibrate = [0, 0.5], period = 3"), 9.0), overlap);
  EXPECT_THAT(refusal(floor, above("vibrate = [0, 0.5], period = 2, shape = \"sine\""), 9.0), overlap);
  // A wall a tenth above the floor that moves with it. With an amplitude of 0.39 it is 0.01 below the floor at the
  // upper end.
  EXPECT_EQ(refusal(floor, above("vibrate = [0, 0.5], period = 2"), 9.0), "");
  EXPECT_EQ(refusal(floor, above("vibrate = [0, 0.41], period = 2"), 9.0), "");
  EXPECT_THAT(refusal(floor, above("vibrate = [0, 0.39], period = 2"), 9.0), overlap);
  EXPECT_EQ(refusal(floor, above("vibrate = [0, 0.39], period = 2"), 0.3), "")
      << "the run ends before they come so near";
  // The wall's motion with the floor must not hide the overlap with another side's motion.
  EXPECT_THAT(
      refusal(floor + "\nleft = { motion = { velocity = [0.5, 0] } }", above("vibrate = [0, 0.5], period = 2"), 9.0),
      HasSubstr("the left side enters the path of this wall at t = 6"));
  EXPECT_EQ(refusal("left = { motion = { velocity = [1, 0] } }", with("velocity = [1, 0]"), 9.0), "");
}

}  // namespace
}  // namespace carom
