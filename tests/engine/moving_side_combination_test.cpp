// Moving sides together with sources, fixed disks and inner walls: closed forms, work, disks crushed against obstacles,
// and scenes that are refused. The agreement of both engines, and resumed runs, are tested in obstacles_test and
// parallel_bits_test.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/check.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/source.hpp"
#include "tests/support/engine_run.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::energy_from_sides;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

std::string scene_text(const std::string& sides, const std::string& rest, const std::string& method, double t_end) {
  return "[box]\nwidth = 20.0\nheight = 20.0\n" + sides + "\n" + rest + "[run]\nmethod = \"" + method +
         "\"\ndt = 0.005\nt_end = " + std::to_string(t_end) + "\n";
}

Scene scene_with(const std::string& sides, const std::string& rest, const std::string& method, double t_end) {
  return parse_scene(scene_text(sides, rest, method, t_end), "motion.toml", "");
}

std::string refusal(const std::string& sides, const std::string& rest, double t_end) {
  try {
    initial_state(scene_with(sides, rest, "exact", t_end));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string peg = "[[disks]]\nfixed = true\ncount = 1\npositions = [[5.0, 10.0]]\nradius = 1.0\n";
const std::string ball =
    "[[disks]]\ncount = 1\npositions = [[10.0, 10.0]]\nvelocities = [[-1.0, 0.0]]\nradius = 1.0\nmass = 2.0\n";
const std::string wall = "[[walls]]\nfrom = [6.0, 5.0]\nto = [6.0, 15.0]\n";
const std::string piston = "right = { motion = { velocity = [-1.0, 0.0] } }";
const std::string gas =
    "[[disks]]\ncount = 60\npositions = \"random\"\nvelocities = { maxwell = 3.0 }\nradius = { uniform = [0.2, 0.5] }\n"
    "mass = { uniform = [1, 9] }\n";

// The ball reaches the obstacle at t = 3, with its edge at x = 6, and comes back at speed 1. The piston, at 20 - t,
// meets the ball's edge, at 8 + (t - 3), at t = 7.5, and sends it back at speed 3.
TEST(MovingSideBesideObstacles, ABallBetweenThem) {
  for (const char* method : methods) {
    for (const std::string& obstacle : {peg, wall}) {
      SCOPED_TRACE(std::string(method) + "\n" + obstacle);
      const Scene scene = scene_with(piston, obstacle + ball, method, 8.0);
      const State end = test::run_by_engine(scene, initial_state(scene));
      EXPECT_NEAR(end.disks.vx[0], -3.0, 1e-12);
      EXPECT_NEAR(end.disks.x[0], 11.5 - 3.0 * 0.5, 1e-11);
      EXPECT_EQ(end.counters.wall_collisions, 2U);
      EXPECT_NEAR(energy_from_sides(end), 8.0, 1e-11);  // from 1 to 9
    }
  }
}

// In each round the ball gains twice the piston's speed; when there is no more room the run ends, and the message has
// time and place.
TEST(LongMovingSideBesideObstacles, StopsWhereItWouldCrushADisk) {
  for (const char* method : methods) {
    for (const std::string& obstacle : {peg, wall}) {
      SCOPED_TRACE(std::string(method) + "\n" + obstacle);
      const Scene scene = scene_with(piston, obstacle + ball, method, 13.5);  // there is room for the ball until t = 12
      State state = initial_state(scene);
      const auto engine = make_parallel_engine(scene, state, {2, 1});
      std::string error;
      try {
        while (engine->state().time < scene.run.t_end) engine->step();
      } catch (const PhysicsError& e) {
        error = e.what();
      }
      EXPECT_THAT(error, AllOf(HasSubstr("t = 1"), HasSubstr("the right side is at x = 8"))) << error;
      EXPECT_LT(engine->state().time, 12.1);
      EXPECT_GT(engine->state().time, 11.5);
    }
  }
}

// Elastic disks: the energy gained is the work, also with disks that come in and with fixed disks.
TEST(MovingSideBesideObstacles, DoesTheWorkThatIsGained) {
  const std::string sides =
      "left = { motion = { velocity = [0.1, 0] } }\nright = { motion = { vibrate = [0.3, 0], period = 1.3 } }\n"
      "bottom = { motion = { vibrate = [0, 0.2], period = 0.7, shape = \"sine\" } }";
  const std::string rest =
      gas +
      "[[disks]]\nfixed = true\ncount = 6\npositions = \"random\"\nregion = [5, 5, 15, 15]\nradius = 0.6\n"
      "[[walls]]\npoints = [[4, 2], [10, 4], [16, 2]]\n"
      "[[sources]]\nside = \"left\"\nrate = 3.0\nradius = 0.2\nmass = 2.0\nvelocities = { maxwell = 2.0 }\n"
      "[[sources]]\nregion = [0, 8, 6, 12]\nrate = 3.0\nradius = 0.2\nmass = 2.0\nvelocities = { maxwell = 2.0 }\n";
  for (const char* method : methods) {
    for (const std::string physics : {"", "[physics]\ngravity = [0.1, -0.3]\n"}) {
      SCOPED_TRACE(std::string(method) + physics);
      const Scene scene = scene_with(sides, physics + rest, method, 12.0);
      const bool exact = scene.run.method == Method::exact;
      const State start = initial_state(scene);
      double deepest = 0.0;
      const State end = test::run_by_engine(scene, start, [&](const State& s) {
        Domain box = box_at(scene.box, s.time);
        const auto cells = place_obstacles(s.obstacles, box);
        deepest = std::max(deepest, wall_overlap(s.disks, box));
      });
      EXPECT_GT(end.counters.emitted, 50U);
      const double after = energy_of(end.disks, scene.physics.gravity).total();
      const double given = energy_of(start.disks, scene.physics.gravity).total() + end.counters.emitted_energy;
      EXPECT_GT(energy_from_sides(end), 0.02 * given);
      const double allowed = exact || physics.empty() ? 1e-12 : 1e-2;  // stepping under gravity is only of first order
      EXPECT_NEAR(given + energy_from_sides(end), after, allowed * after);
      EXPECT_LE(deepest, exact ? 1e-12 : 0.25);
    }
  }
}

// Disks start at the moving side's place, and move inwards in its frame.
TEST(SourceAtAMovingSide, SendsDisksInItsFrame) {
  const std::string source =
      "[[sources]]\nside = \"right\"\nrate = 2.0\nradius = 0.5\nmass = 1.0\nvelocities = { maxwell = 1.0 }\n";
  const Scene moving =
      scene_with(piston + "\ntop = { place = 15, motion = { velocity = [0, 0.1] } }", source, "exact", 4.0);
  const Scene still = scene_with("top = \"wall\"", source, "exact", 4.0);
  const Domain box = box_at(moving.box, 3.0);
  for (DiskId id = 0; id < 50; ++id) {
    const Disk here = draw_emission(moving, box, 0, id, id, id);
    const Disk there = draw_emission(still, still.box, 0, id, id, id);
    EXPECT_EQ(here.x, 17.0 - 0.5);
    EXPECT_EQ(there.x, 20.0 - 0.5);
    EXPECT_LE(here.y, 15.3 - 0.5 + 1e-12);
    EXPECT_NEAR((here.y - 0.5) / 14.3, (there.y - 0.5) / 19.0, 1e-12);
    EXPECT_NEAR(here.vx, there.vx - 1.0, 1e-15);
    EXPECT_EQ(here.vy, there.vy);
  }
}

// Disks come from the part of a region that the side has not yet swept over, and none is beyond the side.
TEST(SourceBesideAMovingSide, EmitsWhereThereIsRoom) {
  const std::string source = "[[sources]]\nregion = [12, 2, 18, 18]\nrate = 40.0\nradius = 0.1\nmass = 1.0\n";
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const Scene scene = scene_with(piston, source, method, 7.0);
    const State end = test::run_by_engine(scene, initial_state(scene), [&](const State& s) {
      EXPECT_LE(wall_overlap(s.disks, box_at(scene.box, s.time)), scene.run.method == Method::exact ? 1e-9 : 0.1);
    });
    EXPECT_GT(end.counters.emitted, 200U);
    EXPECT_LE(*std::max_element(end.disks.x.begin(), end.disks.x.end()), 12.9 + 0.01);
  }
}

// Inner sinks, and a side that is a sink, together with a piston.
TEST(SinkBesideAMovingSide, TakesWhatThePistonDrivesIntoIt) {
  const std::string sink = "[[walls]]\nfrom = [3, 0]\nto = [3, 20]\nkind = \"sink\"\n";
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const State end = [&] {
      const Scene scene = scene_with(piston, sink + ball, method, 8.0);
      return test::run_by_engine(scene, initial_state(scene));
    }();
    EXPECT_EQ(end.counters.removed, 1U);
    const Scene scene = scene_with(piston + "\nleft = \"sink\"", ball, method, 11.0);
    EXPECT_EQ(test::run_by_engine(scene, initial_state(scene)).counters.removed, 1U);
  }
}

TEST(BadMotion, RunsIntoWhatDoesNotYield) {
  EXPECT_EQ(refusal(piston, peg, 13.9), "");
  EXPECT_EQ(refusal(piston, peg, 14.1),
            "motion.toml:8: disks.0.positions: the right side hits fixed disk 0, of radius 1 at (5, 10), at t = 14; "
            "expected fixed disks that no side reaches until run.t_end = 14.1");
  EXPECT_EQ(refusal(piston, wall + ball, 13.9), "");
  EXPECT_EQ(refusal(piston, wall + ball, 14.5),
            "motion.toml:5: walls.0: the right side hits this wall at t = 14; expected walls that no side reaches "
            "until run.t_end = 14.5");
  const std::string shaken =
      "bottom = { motion = { vibrate = [0, -0.5], period = 2 } }";  // the floor moves down at first
  const auto low_wall = [](double y) { return fmt::format("[[walls]]\nfrom = [5, {}]\nto = [9, {}]\n", y, y); };
  EXPECT_EQ(refusal(shaken, low_wall(1.001) + ball, 9.0), "");
  EXPECT_THAT(refusal(shaken, low_wall(0.999) + ball, 9.0), HasSubstr("the bottom side hits this wall at t = 1.4"));
  EXPECT_EQ(refusal(shaken, low_wall(0.999) + ball, 1.4), "") << "the run ends before the floor comes so far";
  EXPECT_THAT(refusal(shaken, low_wall(0.2) + ball, 9.0), HasSubstr("the bottom side hits this wall at t = 0;"));
  // A side may move away from a wall that it touches.
  EXPECT_EQ(refusal("right = { place = 15, motion = { velocity = [1, 0] } }",
                    "[[walls]]\nfrom = [12, 5]\nto = [15, 5]\n" + ball, 2.0),
            "");
}

TEST(BadMotion, SweepsOverARegion) {
  const std::string source =
      "[[sources]]\nregion = [12, 2, 18, 18]\nrate = 1.0\nradius = { uniform = [0.1, 0.5] }\nmass = 1.0\n";
  EXPECT_EQ(refusal(piston, source, 7.4), "");
  EXPECT_EQ(refusal(piston, source, 7.6),
            "motion.toml:6: sources.0.region: the right side leaves no place in this region for the centre of a disk "
            "of radius 0.5 from t = 7.5 on; expected a region of which some part stays free until run.t_end = 7.6");
}

}  // namespace
}  // namespace carom
