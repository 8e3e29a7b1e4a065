// Sides that move: their pieces of parabolas, reflection in their frame, work, adiabats, a ball that bounces in step,
// sides that leave no room.
#include "core/physics/moving_side.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/engine_run.hpp"

namespace carom {
namespace {

using test::energy_from_sides;
using test::run_by_engine;
using testing::AllOf;
using testing::HasSubstr;

const std::string folder = CAROM_SOURCE_DIR "/scenes/";

double total_energy(const Scene& scene, const State& state) {
  return energy_of(state.disks, scene.physics.gravity).total();
}

// Nearly a sine: amplitude, period and phase; place and speed are continuous where pieces meet.
TEST(SideMotion, VibratesInPiecesOfParabolas) {
  SideMotion m;
  m.kind = SideMotion::Kind::vibrate;
  m.inset = 3.0;
  m.amplitude = 0.5;
  m.period = 1.6;
  EXPECT_EQ(m.at(0.0).inset, 3.0);
  EXPECT_NEAR(m.at(0.4).inset, 3.5, 1e-15);
  EXPECT_NEAR(m.at(1.2).inset, 2.5, 1e-15);
  EXPECT_NEAR(m.at(0.4).speed, 0.0, 1e-15);
  EXPECT_EQ(m.largest_inset(9.0), 3.5);
  EXPECT_EQ(m.least_inset(9.0), 2.5);
  EXPECT_NEAR(m.largest_speed(), m.at(0.0).speed, 1e-15);
  for (int k = 0; k < 200; ++k) {
    const double t = 0.0173 * k;
    const double sine = std::sin(2.0 * std::acos(-1.0) * t / m.period);
    EXPECT_NEAR(m.at(t).inset, 3.0 + 0.5 * sine, 0.03);
    const SidePlace later = m.at(t).after(0.001);
    if (m.piece(t) == m.piece(t + 0.001)) {
      EXPECT_NEAR(m.at(t + 0.001).inset, later.inset, 1e-14);
      EXPECT_NEAR(m.at(t + 0.001).speed, later.speed, 1e-13);
    }
    EXPECT_GT(m.piece_end(t), t);
    EXPECT_EQ(m.piece(m.piece_end(t)), m.piece(t) + 1.0);
  }
  for (int k = 1; k < 50; ++k) {
    const double joint = k * m.half();
    EXPECT_NEAR(m.at(joint).speed, m.at(std::nextafter(joint, 0.0)).speed, 1e-12);
    EXPECT_NEAR(m.at(joint).inset, 3.0, 1e-13);
  }
}

// The disk meets a side that goes, comes, and accelerates: closed forms.
TEST(MovingSide, TimeOfContact) {
  EXPECT_EQ(time_to_approach(2.0, 4.0, 0.0), 0.5);
  EXPECT_EQ(time_to_approach(2.0, -4.0, 0.0), HUGE_VAL);
  EXPECT_DOUBLE_EQ(time_to_approach(3.0, 2.0, 2.0), 1.0);    // 2 t + t^2 = 3
  EXPECT_DOUBLE_EQ(time_to_approach(3.0, -2.0, 2.0), 3.0);   // -2 t + t^2 = 3
  EXPECT_DOUBLE_EQ(time_to_approach(0.75, 2.0, -2.0), 0.5);  // 2 t - t^2 = 3 / 4, the first of two
  EXPECT_EQ(time_to_approach(1.25, 2.0, -2.0), HUGE_VAL);
  EXPECT_DOUBLE_EQ(time_to_approach(-1e-17, -1.0, 4.0), 0.5);
}

TEST(MovingSide, ReflectsInItsFrame) {
  for (const Side side : all_sides) {
    double vx = 0.3;
    double vy = 0.3;
    set_outward_speed(side, 2.0, vx, vy);
    const SidePlace place{0.0, 0.5, 0.0};
    const double approach = approach_speed(side, vx, vy, place);
    EXPECT_EQ(approach, 2.5);
    const double change = rebound(side, place, approach, 0.8 * approach, vx, vy);
    EXPECT_EQ(outward_speed(side, vx, vy), -2.5);  // 0.8 * 2.5 away from a side that comes at 0.5
    EXPECT_EQ(change, 4.5);
    EXPECT_EQ(std::min(vx, vy) == 0.3 || std::max(vx, vy) == 0.3, true);
  }
}

// Elastic sides of all kinds of motion: the energy rises by their work alone, and no disk is beyond one.
TEST(MovingSide, DoesTheWorkThatIsGained) {
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    for (const std::string physics : {"", "gravity = 0.4"}) {
      SCOPED_TRACE(method + " " + physics);
      const Scene scene = parse_scene(
          "[box]\nwidth = 20.0\nheight = 16.0\nleft = { motion = { velocity = [0.2, 0] } }\n"
          "right = { place = 19.0, motion = { vibrate = [0.6, 0], period = 1.3 } }\n"
          "bottom = { motion = { vibrate = [0, 0.3], period = 0.7 } }\ntop = { place = 15, motion = { velocity = [0, "
          "0.05] } }\n"
          "[physics]\n" +
              physics +
              "\n[[disks]]\ncount = 80\npositions = \"random\"\nvelocities = { maxwell = 3.0 }\n"
              "radius = { uniform = [0.2, 0.5] }\nmass = { uniform = [1, 9] }\n[run]\nmethod = \"" +
              method + "\"\ndt = 0.005\nt_end = 15.0\n",
          "gas", "");
      const bool exact = scene.run.method == Method::exact;
      const State start = initial_state(scene);
      double deepest = 0.0;
      const State end = run_by_engine(scene, start, [&](const State& s) {
        deepest = std::max(deepest, wall_overlap(s.disks, box_at(scene.box, s.time)));
      });
      const double before = total_energy(scene, start);
      const double after = total_energy(scene, end);
      EXPECT_GT(energy_from_sides(end), 0.05 * before);
      const double allowed = exact || physics.empty() ? 1e-12 : 1e-2;  // stepping under gravity is of first order
      EXPECT_NEAR(before + energy_from_sides(end), after, allowed * after);
      EXPECT_LE(deepest, exact ? 1e-12 : 0.1);
      EXPECT_GT(end.counters.wall_collisions, 200U);
    }
  }
}

// Compressibility of hard disks, good to 0.1 % up to packing fraction 0.65 (core/load/method_choice.cpp).
double compressibility(double eta) {
  const double free = 1.0 - eta;
  return (1.0 + eta * eta / 8.0) / (free * free) - eta * eta * eta * eta / (64.0 * free * free * free * free);
}

// d ln T = -Z d ln V. Centres have the width of the box less a diameter; of packing, half of that counts.
TEST(MovingSide, CompressesAGasAlongItsAdiabat) {
  const Scene scene =
      load_scene(folder + "piston.toml", {{"box.right.motion.velocity", "[-0.1, 0]"}, {"run.t_end", "392.7"}});
  const State start = initial_state(scene);
  const State end = run_by_engine(scene, start);
  const double radius = start.disks.common_radius;
  const double area = static_cast<double>(start.disks.size()) * std::acos(-1.0) * radius * radius;
  const auto width = [&](double t) { return scene.box.width - scene.box.motions[1].at(t).inset - radius; };
  constexpr int parts = 1000;
  double log_ratio = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double from = width(scene.run.t_end * k / parts);
    const double to = width(scene.run.t_end * (k + 1) / parts);
    log_ratio += compressibility(area / (0.5 * (from + to) * scene.box.height)) * std::log(from / to);
  }
  const double before = total_energy(scene, start);
  const double after = total_energy(scene, end);
  EXPECT_NEAR(std::log(after / before), log_ratio, 0.02 * log_ratio);
  EXPECT_GT(log_ratio, 1.2 * std::log(2.0));  // an ideal gas would double its temperature
  EXPECT_NEAR(before + end.counters.side_energy[1], after, 1e-12 * after);
}

// A ball with restitution e bounces once in a period T where the floor moves up at g T (1 - e) / (2 (1 + e)) when it
// lands. That orbit is stable where the floor is slowed down by less than 2 g (1 + e^2) / (1 + e)^2.
TEST(MovingSide, MakesABallBounceInStep) {
  for (const std::string method : {"exact", "pairwise"}) {
    SCOPED_TRACE(method);
    const Scene scene = parse_scene(
        "[box]\nwidth = 4.0\nheight = 10.0\nbottom = { restitution = 0.8, motion = { vibrate = [0, 0.01], period = 1 } "
        "}\n"
        "[physics]\ngravity = 1.0\n[[disks]]\ncount = 1\npositions = [[2, 0.5505]]\nvelocities = [[0, -0.4236]]\n"
        "radius = 0.5\nmass = 2.0\n[run]\nmethod = \"" +
            method + "\"\ndt = 0.0005\nt_end = 400.0\n",
        "ball", "");
    Count halfway = 0;
    double work = 0.0;
    const State end = run_by_engine(scene, initial_state(scene), [&](const State& s) {
      if (s.time > 200.0) return;
      halfway = s.counters.wall_collisions;
      work = s.counters.side_energy[2];
    });
    EXPECT_NEAR(static_cast<double>(end.counters.wall_collisions - halfway), 200.0, 1.0);
    // It lands at w = g T / (1 + e) in the floor's frame, and loses m w^2 (1 - e^2) / 2 a period... of the floor's
    // work.
    const double u = 0.5 * 0.2 / 1.8;
    const double impulse = 2.0 * 1.0;  // m g T, to come up again
    EXPECT_NEAR((end.counters.side_energy[2] - work) / (200.0 * impulse * u), 1.0, 0.01);
  }
}

// What the floor bears, averaged over whole periods, is the weight of the bed; the bed stays in motion.
TEST(MovingSide, BearsTheWeightOfAShakenBed) {
  const Scene scene = load_scene(folder + "shaken_bed.toml");
  State middle;
  const State end = run_by_engine(scene, initial_state(scene), [&](const State& s) {
    if (s.time <= 100.0) middle = s;
  });
  const auto gained = [&](const double(Counters::*what)[4], std::size_t side) {
    return (end.counters.*what)[side] - (middle.counters.*what)[side];
  };
  const double weight = static_cast<double>(end.disks.size()) * scene.physics.gravity;
  const double force =
      (gained(&Counters::wall_impulse, 2) - gained(&Counters::wall_impulse, 3)) / (end.time - middle.time);
  EXPECT_NEAR(force / weight, 1.0, 0.03);
  EXPECT_GT(gained(&Counters::side_energy, 2), 10.0 * std::abs(total_energy(scene, end) - total_energy(scene, middle)));
}

// Disks are placed between the sides where they are at the start; so are those of a region, which must lie there.
TEST(MovingSide, LetsDisksStartWhereThereIsRoom) {
  const auto scene_with = [](const std::string& positions) {
    return parse_scene(
        "[box]\nwidth = 20.0\nheight = 10.0\nleft = { place = 5, motion = { velocity = [0.1, 0] } }\n"
        "right = { place = 12, motion = { vibrate = [0.5, 0], period = 1 } }\n[[disks]]\ncount = 30\npositions = " +
            positions + "\nradius = 0.5\nmass = 1.0\n[run]\nt_end = 1.0\n",
        "inner", "");
  };
  for (const std::string positions :
       {"\"random\"", "\"square\"", "\"hexagonal\"", "\"growth\"", "\"random\"\nregion = [5.5, 1.0, 11.9, 9.5]"}) {
    SCOPED_TRACE(positions);
    const Scene scene = scene_with(positions);
    const Disks disks = initial_state(scene).disks;
    EXPECT_LE(wall_overlap(disks, scene.box), 1e-12);
    EXPECT_GE(*std::min_element(disks.x.begin(), disks.x.end()), 5.5 - 1e-12);
    EXPECT_LE(*std::max_element(disks.x.begin(), disks.x.end()), 11.5 + 1e-12);
  }
  try {
    initial_state(scene_with("\"random\"\nregion = [4.5, 1.0, 11.9, 9.5]"));
    ADD_FAILURE() << "the region reaches beyond the left side";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("region: reaches beyond a side that moves"));
  }
}

// Two disks one above the other, and a ceiling that comes down to less than two diameters.
TEST(MovingSide, StopsWhereItWouldCrushDisks) {
  for (const std::string method : {"elastic exact", "exact", "pairwise", "rollback"}) {
    SCOPED_TRACE(method);
    const bool elastic = method == "elastic exact";
    const Scene scene = parse_scene(
        "[box]\nwidth = 2.1\nheight = 6.0\ntop = { motion = { velocity = [0, -0.5] } }\n[physics]\n" +
            std::string(elastic ? "" : "restitution = 0.5\ncollapse = { model = \"tc\", contact_time = 1e-3 }\n") +
            "[[disks]]\ncount = 2\npositions = [[1.05, 1.5], [1.05, 4.0]]\nvelocities = [[0.1, 0], [0, -0.1]]\n"
            "radius = 1.0\nmass = 1.0\n[run]\nmethod = \"" +
            (elastic ? "exact" : method) + "\"\ndt = 0.01\nt_end = 6.0\n",
        "jam", "");
    std::string error;
    try {
      run_by_engine(scene, initial_state(scene));
    } catch (const PhysicsError& e) {
      error = e.what();
    }
    EXPECT_THAT(error, AllOf(HasSubstr("t = "), HasSubstr("the top side is at y = "))) << error;
  }
}

}  // namespace
}  // namespace carom
