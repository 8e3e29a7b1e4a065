// Lees-Edwards shear: crossings and contacts computed by hand, the balance of energy, bits, units, and scenes that are
// refused.
#include "core/disks/shear.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/energy_gain.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/run_start.hpp"
#include "core/measure/shear_flow.hpp"
#include "core/reference/reference_exact.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/resume_support.hpp"
#include "tests/support/run_in_all_units.hpp"
#include "tests/support/thread_counts.hpp"

namespace carom::test {
namespace {

struct Flow {
  std::string method = "exact", rate = "0.2", radius = "0.5", more_physics, more;
  int disks = 200;
  double width = 24.0, height = 18.0, t_end = 5.0;
};

Scene flow_scene(const Flow& f) {
  return parse_scene(
      fmt::format("[box]\nwidth = {}\nheight = {}\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
                  "top = \"periodic\"\nshear_rate = {}\n[physics]\n{}\n[[disks]]\ncount = {}\npositions = \"random\"\n"
                  "velocities = {{ maxwell = 1.0 }}\nradius = {}\nmass = {{ uniform = [1, 2] }}\n[run]\n"
                  "method = \"{}\"\ndt = 0.005\nt_end = {}\n{}",
                  f.width, f.height, f.rate, f.more_physics, f.disks, f.radius, f.method, f.t_end, f.more),
      "shear.toml", "");
}

// A box of 10 x 10, whose upper images move at 10 times `rate`.
Scene empty_scene(Method method, double rate, double t_end) {
  Scene scene = scene_of(method, 10.0, 10.0, 0.001, t_end);
  set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  scene.box.shear = {rate, rate * 10.0, 0.0};
  return scene;
}

const Method all_methods[] = {Method::exact, Method::pairwise, Method::rollback};
const char* const method_words[] = {"exact", "pairwise", "rollback"};

// x = 1 + t, y = 9 + 2 t: the disk is at the top at t = 1/2, where the image below is at x = 1.5 - 3 / 2 and slower by
// 3.
TEST(Shear, ADiskThatCrossesTheTopComesBackDisplacedAndSlower) {
  for (const Method method : all_methods) {
    const Scene scene = empty_scene(method, 0.3, 2.0);
    const State end = run(scene, state_of({{1.0, 9.0, 1.0, 2.0, 0.5, 2.0}}));
    EXPECT_NEAR(end.disks.x[0], 10.0 + 1.5 - 1.5 - 2.0 * 1.5, 1e-11);
    EXPECT_NEAR(end.disks.y[0], 3.0, 1e-11);
    EXPECT_NEAR(end.disks.vx[0], -2.0, 1e-13);
    EXPECT_NEAR(end.disks.vy[0], 2.0, 1e-13);
    EXPECT_NEAR(end.counters.shear_work, 0.5 * 2.0 * (4.0 - 1.0), 1e-12);
  }
}

// The upper image of the second disk moves from (3, 11.5) at (-1 + 4, -1): at t = 0.9 it is at (5.7, 10.6), a diameter
// above the first disk.
TEST(Shear, DisksMeetAcrossTheBorder) {
  for (const Method method : all_methods) {
    const Scene scene = empty_scene(method, 0.4, 1.0);
    const State start = state_of({{3.9, 8.7, 2.0, 1.0, 0.5, 1.0}, {3.0, 1.5, -1.0, -1.0, 0.5, 1.0}});
    const State end = run(scene, start);
    ASSERT_EQ(end.counters.collisions, 1U);
    // In the frame of the top (2, 1) and (3, -1) exchange their components along y.
    EXPECT_NEAR(end.disks.vx[0], 2.0, 1e-11);
    EXPECT_NEAR(end.disks.vy[0], -1.0, 1e-11);
    EXPECT_NEAR(end.disks.vx[1], -1.0, 1e-11);
    EXPECT_NEAR(end.disks.vy[1], 1.0, 1e-11);
    EXPECT_NEAR(end.disks.x[0], 3.9 + 2.0, 1e-11);
    EXPECT_NEAR(end.disks.y[0], 8.7 + 0.9 - 0.1, 1e-11);
    EXPECT_NEAR(end.disks.y[1], 1.5 - 0.9 + 0.1, 1e-11);
    EXPECT_NEAR(end.counters.shear_virial, 0.0, 1e-11) << "the line of centres is along y";
    EXPECT_NEAR(end.counters.shear_work, 0.0, 1e-11) << "no momentum along x has been transferred";
  }
}

// Both disks are at rest.
TEST(Shear, ThePassingImagePushesAlongTheFlow) {
  for (const Method method : all_methods) {
    const Scene scene = empty_scene(method, 0.5, 1.0);
    // The upper image of the second disk passes at speed 5, 0.1 above the first.
    const State start = state_of({{6.5, 9.9, 0.0, 0.0, 0.5, 1.0}, {2.0, 0.0, 0.0, 0.0, 0.5, 1.0}});
    const State end = run(scene, start);
    ASSERT_EQ(end.counters.collisions, 1U);
    const double ny = 0.1, nx = std::sqrt(1.0 - ny * ny);  // from the image to the first one: (nx, -ny)
    EXPECT_NEAR(end.disks.vx[0], 5.0 * nx * nx, 1e-10);
    EXPECT_NEAR(end.disks.vy[0], -5.0 * nx * ny, 1e-10);
    EXPECT_NEAR(end.disks.vx[1], -5.0 * nx * nx, 1e-10) << "the disk was at rest, its image moved at 5";
    EXPECT_NEAR(end.disks.vy[1], 5.0 * nx * ny, 1e-10);
    EXPECT_NEAR(end.counters.virial, 5.0 * nx, 1e-10);
    EXPECT_NEAR(end.counters.shear_virial, -5.0 * nx * nx * ny, 1e-10);
    EXPECT_NEAR(end.counters.shear_work, energy_of(end.disks, 0.0).kinetic, 1e-10);
  }
}

TEST(Shear, TheOffsetIsAsSmoothAsTime) {
  const Shear shear{0.1, 1.7, 0.0};
  const double width = 3.0;
  for (const double t : {0.0, 1.0, 1e3, 1e9}) {
    for (double dt = 0.25; dt < 2.0; dt += 0.25) {
      double slid = shear.offset_at(t + dt, width) - shear.offset_at(t, width);
      slid -= width * std::round((slid - 1.7 * dt) / width);
      EXPECT_NEAR(slid, 1.7 * dt, 4e-15 * width) << t;
    }
    EXPECT_LE(std::abs(shear.offset_at(t, width)), 0.5 * width * (1.0 + 1e-15));
  }
}

// Elastic disks: the energy gained is the work of the images, to rounding, in every method.
TEST(Shear, WorkIsTheEnergyGained) {
  for (const char* method : method_words) {
    for (const char* rate : {"0.3", "-0.7"}) {
      Flow f;
      f.method = method;
      f.rate = rate;
      const Scene scene = flow_scene(f);
      const State start = initial_state(scene);
      const State end = run(scene, start);
      const double before = energy_of(start.disks, 0.0).kinetic, after = energy_of(end.disks, 0.0).kinetic;
      EXPECT_GT(end.counters.collisions, 300U);
      EXPECT_GT(after, before * 1.02) << "the flow must heat the disks";
      EXPECT_NEAR((before + end.counters.shear_work) / after, 1.0, 1e-12) << method;
      EXPECT_TRUE(energy_warnings(scene, run_start(start, scene), end).empty());
      const Momentum p = momentum_of(relative_to_flow(end.disks, scene.box));
      EXPECT_NEAR(p.x / p.magnitude, 0.0, 1e-12) << "relative to the flow";
      EXPECT_NEAR(p.y / p.magnitude, 0.0, 1e-12);
    }
  }
}

TEST(Shear, ExactDisksNeverOverlap) {
  Flow f;
  f.rate = "0.5";
  const Scene scene = flow_scene(f);
  run(scene, initial_state(scene), [&](const Engine& engine) {
    EXPECT_LT(max_overlap(engine.state().disks, box_at(scene.box, engine.state().time)), 1e-12);
    Disks between;  // frames are computed from the paths
    const double t = engine.state().time - 1e-3;
    ASSERT_EQ(engine.disks_at(t, between), t);
    EXPECT_LT(max_overlap(between, box_at(scene.box, t)), 1e-12);
  });
}

State run_on(const Scene& scene, const State& start, int threads, std::size_t divisor) {
  const auto engine = make_parallel_engine(scene, start, {threads, divisor});
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

// A thermostat with the friction 2 rate (N T - N T0) removes the heat of the shear, stress times rate and area; the
// temperature follows from the equality of both. The noise acts on velocities relative to the flow, whose mean stays 0.
TEST(LongShear, ABathTakesTheHeatOfTheFlow) {
  Flow f;
  f.disks = 400;
  f.width = f.height = 40.0;
  f.rate = "0.4";
  f.more_physics = "thermostat = { kind = \"langevin\", temperature = 1.0, rate = 0.05, dt = 0.02 }";
  f.t_end = 240.0;
  const Scene scene = flow_scene(f);
  const State start = initial_state(scene);
  const auto engine = make_parallel_engine(scene, start, {2, 1});
  while (engine->state().time < 60.0) engine->step();
  const State early = engine->state();
  double temperature = 0.0, weight = 0.0, last = early.time, flow = 0.0;
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    const Disks relative = relative_to_flow(engine->state().disks, scene.box);
    const double passed = engine->state().time - last;
    temperature += passed * energy_of(relative, 0.0).kinetic / 400.0;
    flow += passed * momentum_of(relative).x / 400.0;
    weight += passed;
    last = engine->state().time;
  }
  const Counters& late = engine->state().counters;
  const double work = late.shear_work - early.counters.shear_work;
  const double heat = late.thermostat_heat - early.counters.thermostat_heat;
  const double gain = energy_of(engine->state().disks, 0.0).kinetic - energy_of(early.disks, 0.0).kinetic;
  EXPECT_NEAR(gain, work + heat, 1e-9 * work);
  const double expected = 1.0 + work / weight / (2.0 * 0.05 * 400.0);
  EXPECT_GT(expected, 2.0) << "the flow must heat the disks";
  EXPECT_NEAR(temperature / weight / expected, 1.0, 0.02);
  EXPECT_NEAR(flow / weight, 0.0, 0.2) << "the mean of this walk over 9 times 1 / rate scatters by 0.04";
}

TEST(Shear, AThermostatHasTheSameBitsOnAnyThreads) {
  for (const char* kind : {"langevin", "andersen"}) {
    for (const char* method : method_words) {
      Flow f;
      f.method = method;
      f.t_end = 2.0;
      f.disks = 90;
      f.more_physics = fmt::format("thermostat = {{ kind = \"{}\", temperature = 0.7, rate = 0.6, dt = 0.11 }}", kind);
      const Scene scene = flow_scene(f);
      const State start = initial_state(scene);
      const State expected = run(scene, start);
      EXPECT_NE(expected.counters.thermostat_heat, 0.0);
      for (const int threads : {1, 3}) {
        const State end = run_on(scene, start, threads, 128);
        EXPECT_EQ(state_hash(end.disks), state_hash(expected.disks)) << kind << " " << method << " " << threads;
        EXPECT_EQ(end.counters.thermostat_heat, expected.counters.thermostat_heat);
        EXPECT_EQ(end.counters.shear_work, expected.counters.shear_work);
      }
      expect_same_bits(scene, start, 30, 1);
    }
  }
}

// Disks that move with the flow have no relative velocities, however high the box: windows are as long in a box four
// times as wide and high.
TEST(Shear, WindowsOfAHighBoxAreAsLong) {
  std::array<Count, 2> windows{};
  for (const int size : {1, 4}) {
    Flow f;
    f.rate = "0.5";
    f.disks = 200 * size * size;
    f.width *= size;
    f.height *= size;
    const Scene scene = flow_scene(f);
    windows[size == 1 ? 0 : 1] = run_on(scene, initial_state(scene), 2, 1).counters.steps;
  }
  EXPECT_LE(windows[1], windows[0] + 2);
}

// The box is so high that most disks are far from the moving images.
TEST(LongShear, SameBitsFarFromTheImages) {
  for (const char* radius : {"0.5", "{ uniform = [0.05, 0.6] }"}) {
    Flow f;
    f.radius = radius;
    f.disks = 500;
    f.width = 30.0;
    f.height = 60.0;
    const Scene scene = flow_scene(f);
    const State start = initial_state(scene);
    const State expected = run(scene, start);
    EXPECT_GT(expected.counters.collisions, 500U);
    for (const int threads : test::thread_counts) {
      const State end = run_on(scene, start, threads, 1);
      EXPECT_EQ(state_hash(end.disks), state_hash(expected.disks)) << threads;
      EXPECT_EQ(end.counters.shear_work, expected.counters.shear_work) << threads;
    }
  }
}

TEST(LongShear, SameBitsOnAnyThreads) {
  for (const char* radius : {"0.5", "{ uniform = [0.05, 0.6] }", "{ choice = [0.05, 0.1, 1.2] }"}) {
    for (const char* rate : {"0.2", "-1.5"}) {
      for (const char* method : method_words) {
        Flow f;
        f.method = method;
        f.rate = rate;
        f.radius = radius;
        f.t_end = 3.0;
        f.disks = 90;
        const Scene scene = flow_scene(f);
        const State start = initial_state(scene);
        const State expected = run(scene, start);
        SCOPED_TRACE(fmt::format("{} {} {}", method, rate, radius));
        EXPECT_GT(expected.counters.collisions, 20U);
        for (const int threads : test::thread_counts) {
          for (const std::size_t divisor : {std::size_t{1}, std::size_t{128}}) {
            const State end = run_on(scene, start, threads, divisor);
            EXPECT_EQ(state_hash(end.disks), state_hash(expected.disks)) << threads;
            EXPECT_EQ(end.counters.collisions, expected.counters.collisions) << threads;
            EXPECT_EQ(end.counters.virial, expected.counters.virial) << threads;
            EXPECT_EQ(end.counters.shear_work, expected.counters.shear_work) << threads;
            EXPECT_EQ(end.counters.shear_virial, expected.counters.shear_virial) << threads;
          }
        }
      }
    }
  }
}

TEST(Shear, ARunThatIsTakenUpAgainHasTheSameBits) {
  for (const char* method : method_words) {
    Flow f;
    f.method = method;
    f.rate = "-0.4";
    const Scene scene = flow_scene(f);
    expect_same_bits(scene, initial_state(scene), 30, 1);
  }
}

TEST(Shear, IsTheSameInAllUnits) {
  for (const char* method : method_words) {
    Flow f;
    f.method = method;
    f.t_end = 1.5;
    expect_same_in_all_units(flow_scene(f));
  }
}

TEST(Shear, RateZeroIsThePlainBox) {
  for (const char* method : method_words) {
    Flow f;
    f.method = method;
    f.rate = "0.0";
    const Scene scene = flow_scene(f);
    EXPECT_FALSE(scene.box.shear.acts());
    const State end = run(scene, initial_state(scene));
    EXPECT_EQ(end.counters.shear_work, 0.0);
    EXPECT_LT(std::abs(energy_of(end.disks, 0.0).kinetic / energy_of(initial_state(scene).disks, 0.0).kinetic - 1.0),
              1e-12);
  }
}

// Other lengths of windows change the results only by rounding, for a while.
TEST(Shear, WindowsDoNotMatter) {
  Flow f;
  f.t_end = 0.8;
  f.disks = 60;
  const Scene scene = flow_scene(f);
  const State start = initial_state(scene);
  const auto end_with = [&](double scale) {
    const auto engine = make_reference_exact(scene, start, scale);
    while (engine->state().time < scene.run.t_end) engine->step();
    return engine->state();
  };
  const State one = end_with(1.0), other = end_with(0.37);
  EXPECT_EQ(one.counters.collisions, other.counters.collisions);
  for (std::size_t i = 0; i < one.disks.size(); ++i) EXPECT_NEAR(one.disks.vx[i], other.disks.vx[i], 1e-8);
}

std::string refusal(const Flow& f) {
  try {
    flow_scene(f);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Shear, RefusesWhatItDoesNotGoWith) {
  Flow f;
  EXPECT_EQ(refusal(f), "");
  const auto with_physics = [](const std::string& line) {
    Flow g;
    g.more_physics = line;
    return refusal(g);
  };
  EXPECT_EQ(with_physics("gravity = 1.0"),
            "shear.toml:8: box.shear_rate: cannot be used with physics.gravity; expected one of the two");
  EXPECT_NE(with_physics("diffusion = 0.1").find("cannot be used with physics.diffusion"), std::string::npos);
  EXPECT_NE(with_physics("restitution = 0.5\ncollapse = { model = \"tc\", contact_time = 1e-6 }")
                .find("cannot be used with physics.collapse"),
            std::string::npos);
  f.method = "auto";
  f.more = "accuracy = 0.01\n";
  EXPECT_EQ(refusal(f),
            "shear.toml:18: run.method: is \"auto\", but the errors of methods with box.shear_rate are not known; "
            "expected a method by name");
  f = {};
  f.more = "[[walls]]\nfrom = [1.0, 1.0]\nto = [2.0, 2.0]\n";
  EXPECT_NE(refusal(f).find("cannot be used with [[walls]]"), std::string::npos);
  f.more = "[[sources]]\nregion = [1, 1, 5, 5]\nrate = 1.0\nradius = 0.1\nmass = 1.0\n";
  EXPECT_NE(refusal(f).find("cannot be used with [[sources]]"), std::string::npos);
  f.more = "[[disks]]\nfixed = true\ncount = 1\npositions = \"random\"\nradius = 0.1\n";
  EXPECT_NE(refusal(f).find("cannot be used with fixed disks"), std::string::npos);
  f = {};
  f.rate = "1e31";
  EXPECT_EQ(refusal(f), "shear.toml:8: box.shear_rate: is 1e+31; expected a rate from 1e-30 to 1e+30");
  f.rate = "\"fast\"";
  EXPECT_NE(refusal(f).find("box.shear_rate: is a string"), std::string::npos);
  f = {};
  f.width = 3.9;
  f.disks = 2;
  EXPECT_NE(refusal(f).find("expected sides of at least 4, four diameters of the largest disk"), std::string::npos);
}

}  // namespace
}  // namespace carom::test
