// Moving sides: their motion in pieces of parabolas, reflection in their frame, work, the weight that they bear, and
// sides that leave no room.
#include "core/physics/moving_side.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check.hpp"
#include "core/base/sine.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/physics/swinging_side.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/draws.hpp"
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

// Vibration, nearly a sine: amplitude, period and phase; place and speed are continuous at the joints of pieces.
TEST(SideMotion, VibratesInPiecesOfParabolas) {
  SideMotion m;
  m.kind = SideMotion::Kind::parabolas;
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

// The time at which two pieces meet belongs to the later one, and the floating-point number before it to the earlier
// one, however the quotient by half a period is rounded. So a window that ends with a piece has a length above 0.
TEST(SideMotion, PiecesMeetAtWholeHalfPeriods) {
  test::Draws draws(11);
  SideMotion m;
  m.kind = SideMotion::Kind::parabolas;
  m.amplitude = 0.5;
  for (int n = 0; n < 20000; ++n) {
    m.period = draws.decades(1e-3, 1e3);
    const double k = std::floor(draws.decades(1.0, 1e7));
    const double joint = k * m.half();
    ASSERT_EQ(m.piece(joint), k) << m.period;
    ASSERT_EQ(m.piece(std::nextafter(joint, 0.0)), k - 1.0) << m.period;
    ASSERT_GT(m.piece_end(joint), joint);
  }
}

// Compared with the C library's sine in long double, over many periods and scales.
TEST(SineInPeriod, IsRightToALastBitOrTwo) {
  constexpr auto pi = 3.141592653589793238462643383279502884L;
  double largest = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const double period = std::ldexp(1.0 + 0.37 * std::fmod(0.618 * k, 1.0), k % 60 - 30);
    const double t = period * std::fmod(0.7548776662 * k, 1.0) * (k % 3 == 0 ? 1.0 : 1e4);
    const auto angle = 2.0L * pi * std::fmod(static_cast<long double>(t), static_cast<long double>(period)) /
                       static_cast<long double>(period);
    const SineCosine found = sine_in_period(t, period);
    largest = std::max(largest, std::abs(static_cast<double>(static_cast<long double>(found.sine) - std::sin(angle))));
    largest =
        std::max(largest, std::abs(static_cast<double>(static_cast<long double>(found.cosine) - std::cos(angle))));
  }
  EXPECT_LT(largest, 4e-16);
  EXPECT_GT(largest, 0.0);
  for (const double period : {1.0, 0.3, 1e-80, 1e80}) {
    for (int quarter = 0; quarter < 5; ++quarter) {
      constexpr double sines[] = {0.0, 1.0, 0.0, -1.0};
      if (quarter % 4 == 3) continue;  // three quarters of the period may not be a double
      const double t = 0.25 * quarter * period;
      EXPECT_EQ(sine_in_period(t, period).sine, sines[quarter % 4]) << period << ", " << quarter;
      EXPECT_EQ(sine_in_period(t, period).cosine, sines[(quarter + 1) % 4]) << period << ", " << quarter;
    }
  }
}

TEST(SideMotion, VibratesAsASine) {
  SideMotion m;
  m.kind = SideMotion::Kind::sine;
  m.inset = 3.0;
  m.amplitude = -0.5;
  m.period = 1.6;
  const double w = 2.0 * std::acos(-1.0) / m.period;
  EXPECT_EQ(m.at(0.4).inset, 2.5);
  EXPECT_NEAR(m.at(1.2).inset, 3.5, 1e-15);
  EXPECT_NEAR(m.at(0.0).speed, -0.5 * w, 1e-15);
  EXPECT_EQ(m.largest_inset(9.0), 3.5);
  EXPECT_NEAR(m.largest_speed(), 0.5 * w, 1e-15);
  for (int k = 0; k < 100; ++k) {
    const double t = 0.0373 * k;
    EXPECT_NEAR(m.at(t).inset, 3.0 - 0.5 * std::sin(w * t), 2e-15);
    EXPECT_NEAR(m.at(t).speed, -0.5 * w * std::cos(w * t), 1e-14);
    EXPECT_NEAR(m.at(t).acceleration, 0.5 * w * w * std::sin(w * t), 4e-14);
    const SidePlace later = m.swung(m.at(t), 0.77);
    EXPECT_NEAR(later.inset, m.at(t + 0.77).inset, 4e-15);
    EXPECT_NEAR(later.speed, m.at(t + 0.77).speed, 1e-14);
  }
  EXPECT_NEAR(m.first_time_beyond(3.25, 9.0), 0.8 + 1.6 / 12.0, 1e-14);
  EXPECT_EQ(m.first_time_beyond(3.25, 0.9), HUGE_VAL);
}

// For many paths, grazing ones among them: before the contact no gap is negative, and at the contact the gap is 0.
TEST(SwingingSide, IsMetAtTheFirstContact) {
  SideMotion m;
  m.kind = SideMotion::Kind::sine;
  m.inset = 2.0;
  int contacts = 0;
  for (int k = 0; k < 3000; ++k) {
    const auto u = [&](double ratio) { return std::fmod(ratio * (k + 1), 1.0); };
    m.amplitude = 2.0 * u(0.6180339887) - 1.0;
    m.period = 0.3 + 3.0 * u(0.7548776662);
    const SidePlace now = m.at(10.0 * u(0.5698402910));
    const double gap = now.inset + (k % 3 == 0 ? 0.0 : 3.0 * u(0.8191725134));
    const double outward = 3.0 * (u(0.6710436067) - 0.3);
    const double g = k % 2 == 0 ? 0.0 : 2.0 * u(0.5497004779) - 0.8;
    const double found = time_to_swinging_side({m, now}, gap, outward, g, 20.0);
    const auto gap_at = [&](double t) { return gap - (outward * t + 0.5 * g * t * t) - m.swung(now, t).inset; };
    const double until = found < HUGE_VAL ? found : 20.0;
    for (int j = 1; j < 500; ++j) ASSERT_GT(gap_at(until * j / 500.0), -1e-12) << k << ", " << j;
    if (found == HUGE_VAL) continue;
    ++contacts;
    EXPECT_NEAR(gap_at(found), 0.0, 2e-13) << k;
    EXPECT_GE(outward + g * found + m.swung(now, found).speed, 0.0) << k;
  }
  EXPECT_GT(contacts, 2000);
}

// A disk meets a side that recedes, approaches, or accelerates: closed forms.
TEST(MovingSide, TimeOfContact) {
  EXPECT_EQ(time_to_approach(2.0, 4.0, 0.0), 0.5);
  EXPECT_EQ(time_to_approach(2.0, -4.0, 0.0), HUGE_VAL);
  EXPECT_DOUBLE_EQ(time_to_approach(3.0, 2.0, 2.0), 1.0);    // 2 t + t^2 = 3
  EXPECT_DOUBLE_EQ(time_to_approach(3.0, -2.0, 2.0), 3.0);   // -2 t + t^2 = 3
  EXPECT_DOUBLE_EQ(time_to_approach(0.75, 2.0, -2.0), 0.5);  // 2 t - t^2 = 3 / 4, the earlier root
  EXPECT_EQ(time_to_approach(1.25, 2.0, -2.0), HUGE_VAL);
  EXPECT_DOUBLE_EQ(time_to_approach(-1e-17, -1.0, 4.0), 0.5);
  for (const double acceleration : {-1.0, 0.0, 1.0}) EXPECT_EQ(time_to_approach(-0.5, 4.0, acceleration), 0.0);
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
    EXPECT_EQ(outward_speed(side, vx, vy), -2.5);  // (0.8 of 2.5) away from a side that comes in at 0.5
    EXPECT_EQ(change, 4.5);
    EXPECT_EQ(std::min(vx, vy) == 0.3 || std::max(vx, vy) == 0.3, true);
  }
}

// With elastic sides that move in any way the energy changes by their work alone, and no disk is beyond a side.
TEST(MovingSide, DoesTheWorkThatIsGained) {
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    for (const std::string physics : {"", "gravity = 0.4"}) {
      SCOPED_TRACE(method + " " + physics);
      const Scene scene = parse_scene(
          "[box]\nwidth = 20.0\nheight = 16.0\nleft = { motion = { velocity = [0.2, 0] } }\n"
          "right = { place = 19.0, motion = { vibrate = [0.6, 0], period = 1.3 } }\n"
          "bottom = { motion = { vibrate = [0, 0.3], period = 0.7 } }\ntop = { place = 15, motion = "
          "{ velocity = [0, "
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
      const double allowed = exact || physics.empty() ? 1e-12 : 1e-2;  // stepping under gravity is only of first order
      EXPECT_NEAR(before + energy_from_sides(end), after, allowed * after);
      EXPECT_LE(deepest, exact ? 1e-12 : 0.1);
      EXPECT_GT(end.counters.wall_collisions, 200U);
    }
  }
}

// Averaged over whole periods the floor bears the weight of the bed, which stays in motion.
TEST(LongMovingSide, BearsTheWeightOfAShakenBed) {
  const Scene scene = load_scene(folder + "shaken_bed.toml");
  State middle;
  const State end = run_by_engine(scene, initial_state(scene), [&](const State& s) {
    if (s.time <= 100.0) middle = s;
  });
  const auto gained = [&](const double(Counters::*what)[4], std::size_t side) {
    return (end.counters.*what)[side] - (middle.counters.*what)[side];
  };
  const double weight = static_cast<double>(end.disks.size()) * scene.physics.gravity.down;
  const double force =
      (gained(&Counters::wall_impulse, 2) - gained(&Counters::wall_impulse, 3)) / (end.time - middle.time);
  EXPECT_NEAR(force / weight, 1.0, 0.03);
  EXPECT_GT(gained(&Counters::side_energy, 2), 10.0 * std::abs(total_energy(scene, end) - total_energy(scene, middle)));
}

// Disks are placed between the sides as these are at the start; a region for disks must lie there, too.
TEST(MovingSide, LetsDisksStartWhereThereIsRoom) {
  const auto scene_with = [](const std::string& positions, Count count = 30) {
    return parse_scene(
        "[box]\nwidth = 20.0\nheight = 10.0\nleft = { place = 5, motion = { velocity = [0.1, 0] } }\n"
        "right = { place = 12, motion = { vibrate = [0.5, 0], period = 1 } }\n[[disks]]\ncount = " +
            std::to_string(count) + "\npositions = " + positions + "\nradius = 0.5\nmass = 1.0\n[run]\nt_end = 1.0\n",
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
    ADD_FAILURE() << "no error, though the region reaches beyond the left side";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("region: reaches beyond a moving side"));
  }
  try {
    initial_state(scene_with("[[5.3, 1.0], [8.0, 5.0]]", 2));
    ADD_FAILURE() << "no error, though the first disk is in the left side";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("disk 0 of radius 0.5 at (5.3, 1) is not between the sides at time 0, which are "
                          "at x = 5 and 12, y = 0 and 10"));
  }
}

// Two disks one above the other, and a ceiling that comes down to less than two diameters above the floor.
TEST(LongMovingSide, StopsWhereItWouldCrushDisks) {
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    SCOPED_TRACE(method);
    const bool exact = method == "exact";
    const Scene scene = parse_scene(
        "[box]\nwidth = 2.1\nheight = 6.0\ntop = { motion = { velocity = [0, -0.5] } }\n[physics]\n" +
            std::string(exact ? "" : "restitution = 0.5\n") +
            "[[disks]]\ncount = 2\npositions = [[1.05, 1.5], [1.05, 4.0]]\nvelocities = [[0.1, 0], [0, -0.1]]\n"
            "radius = 1.0\nmass = 1.0\n[run]\nmethod = \"" +
            method + "\"\ndt = 0.01\nt_end = 6.0\n",
        "jam", "");
    State state = initial_state(scene);
    const auto error_of = [&](Engine& engine) -> std::string {
      try {
        while (engine.state().time < scene.run.t_end) engine.step();
      } catch (const PhysicsError& e) {
        state = engine.state();
        return e.what();
      }
      return "";
    };
    const std::string error = error_of(*make_parallel_engine(scene, state, {2, 1}));
    EXPECT_THAT(error, AllOf(HasSubstr("t = "), HasSubstr("the top side is at y = "))) << error;
    // A run resumed from where this one stopped must stop with the same error.
    const double left_at = state.time;
    EXPECT_THAT(error_of(*make_parallel_engine(scene, state, {1, 1})), HasSubstr("the top side is at y = "));
    EXPECT_EQ(state.time > left_at, exact);
  }
}

// A disk at the side, with the side's speed, that the side presses touches it now; otherwise it would sink in.
TEST(SwingingSide, IsTouchedByADiskThatItPresses) {
  SwingSearch search{2.0};
  EXPECT_FALSE(search.go_on({0.0, 0.0, 1.0}, 1.0, 4.0));
  EXPECT_TRUE(search.go_on({0.0, 0.0, -1.0}, 1.0, 4.0));
}

// The search for the next contact of a disk that has just left makes progress even if the time since the window's
// start, in periods, is so large that its rounding is coarse.
TEST(SwingingSide, IsSearchedForThoughTimeIsCoarse) {
  for (const double t : {0.0, 1.0, 1e6, 1e12}) {
    SwingSearch search{1.0};
    search.t = t;
    ASSERT_TRUE(search.go_on({0.0, -1e-30, 4.0}, 1.0, 4.0));
    EXPECT_GT(search.t, t);
  }
}

}  // namespace
}  // namespace carom
