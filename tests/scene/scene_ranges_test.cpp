// Numbers beyond the range of the formulas are refused in one line; within it runs are right for numbers of any size.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/measure/invariants.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/command_support.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::sound_scene;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string with(std::string_view from, std::string_view to) {
  return complaint(replaced(sound_scene, from, to));
}

TEST(Range, OfEachNumber) {
  EXPECT_EQ(with("width = 20.0", "width = 1e80"),
            "gas.toml:5: box.width: is 1e+80; expected a length from 1e-30 to 1e+30");
  EXPECT_THAT(with("radius = 1.0", "radius = 1e-100"),
              StartsWith("gas.toml:17: disks.0.radius: is 1e-100; expected a l"));
  EXPECT_THAT(with("radius = 1.0", "radius = [1, 1e-31, 1]"), StartsWith("gas.toml:17: disks.0.radius.1: is 1e-31"));
  EXPECT_THAT(with("mass = 2.0", "mass = 1e307"),
              StartsWith("gas.toml:18: disks.0.mass: is 1e+307; expected a mass fr"));
  EXPECT_THAT(with("mass = 2.0", "mass = [1, 1, 1e51]"), StartsWith("gas.toml:18: disks.0.mass.2: is 1e+51"));
  EXPECT_THAT(
      with("mass = 2.0", "mass = { uniform = [1e307, 1e308] }"),
      AllOf(StartsWith("gas.toml:18: disks.0.mass: gets values between"), HasSubstr("expected a mass from 1e-50")));
  EXPECT_THAT(with("mass = 2.0", "mass = { from_radius = 1e60 }"),
              StartsWith("gas.toml:18: disks.0.mass: gets the value 3.14159"));
  EXPECT_THAT(with("t_end = 10.0", "t_end = 1e155"), StartsWith("gas.toml:23: run.t_end: is 1e+155; expected a time"));
  EXPECT_THAT(with("dt = 0.01", "dt = 1e280"), StartsWith("gas.toml:22: run.dt: is 1e+280; expected a time"));
  EXPECT_THAT(with("restitution = 0.5", "gravity = 1e-91"),
              HasSubstr("11: physics.gravity: is 1e-91; expected an acc"));
  EXPECT_THAT(with("restitution = 0.5", "diffusion = 1e91"),
              HasSubstr("11: physics.diffusion: is 1e+91; expected a dif"));
  EXPECT_THAT(with("maxwell = 1.0", "maxwell = 1e171"),
              HasSubstr("16: disks.0.velocities.maxwell: is 1e+171; expected an"));
  EXPECT_THAT(with("maxwell = 1.0", "uniform = 1e61"),
              HasSubstr("16: disks.0.velocities.uniform: is 1e+61; expected a s"));
  EXPECT_THAT(
      with("{ maxwell = 1.0 }", "[[0, 0], [1e61, 0], [0, 0]]"),
      StartsWith("gas.toml:16: disks.0.velocities.1: is [1e+61, 0]: it has a speed of 1e+61; expected a speed of"));
  EXPECT_THAT(with("[5, 5]", "[5, 1e31]"),
              StartsWith("gas.toml:15: disks.0.positions.1: is [5, 1e+31]; expected lengths"));
  const FrameReader frames = [](const FrameAsked&) -> SceneFrame {
    return {{}, {}, {1.0, -1.0, 1.0}, {1.0, 1e60, 1.0}};
  };
  const auto with_frame = [&](std::string_view from, std::string_view to) -> std::string {
    try {
      parse_scene(replaced(sound_scene, from, to), "gas.toml", "", {}, frames);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(with_frame("radius = 1.0", "radius = { frame = \"out\" }"),
              HasSubstr("radius: gets values between -1 and 1;"));
  EXPECT_THAT(with_frame("mass = 2.0", "mass = { frame = \"out\" }"),
              HasSubstr("mass: gets values between 1 and 1e+60;"));
  EXPECT_EQ(with("t_end = 10.0", "t_end = 0"), "");
  EXPECT_EQ(with("{ maxwell = 1.0 }", "[[0, 5e-324], [-0.0, 0], [1e-200, 0]]"), "") << "no speed is too small";
}

// The limit must not ask for a mass of fixed disks, nor use the number stored in its place.
TEST(Range, OfSpeedsFromBathsLeavesFixedDisksOut) {
  const std::string heavy =
      "[box]\nwidth = 20.0\nheight = 20.0\n[physics]\nthermostat = { kind = \"langevin\", temperature = 1e26, rate = "
      "0.5, dt = 0.1 }\n[[disks]]\ncount = 2\npositions = [[5.0, 5.0], [10.0, 10.0]]\nradius = 1.0\nmass = 1e26\n";
  const std::string peg = "[[disks]]\ncount = 1\npositions = [[15.0, 15.0]]\nradius = 1.0\nfixed = true\n";
  const std::string run = "[run]\nt_end = 1e6\n";
  EXPECT_EQ(complaint(heavy + run), "");
  EXPECT_EQ(complaint(heavy + peg + run), "");
  EXPECT_THAT(complaint(heavy + "[[disks]]\ncount = 1\npositions = [[15.0, 15.0]]\nradius = 1.0\nmass = 1.0\n" + run),
              HasSubstr("physics.thermostat.temperature: is 1e+26: a disk of mass 1 crosses the box"));
}

// A frame of a run whose disks have all left has no spins, so there are too few.
TEST(Range, OfSpinsFromAFrameWithoutDisks) {
  const std::string text =
      replaced(replaced(sound_scene, "restitution = 0.5", "roughness = { tangential_restitution = 0.5 }"), "mass = 2.0",
               "mass = 2.0\nspin = { frame = \"out\" }");
  try {
    parse_scene(text, "gas.toml", "", {}, [](const FrameAsked&) { return SceneFrame{}; });
    ADD_FAILURE() << "read";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "gas.toml:19: disks.0.spin: has 0 entries for count = 3; expected one entry for each disk");
  }
}

TEST(Range, OfZeroHasNoSign) {
  const Scene scene = parse_scene(replaced(sound_scene, "t_end = 10.0", "t_end = -0.0"), "gas.toml", "");
  EXPECT_FALSE(std::signbit(scene.run.t_end));
}

TEST(Range, OfNumbersAgainstEachOther) {
  EXPECT_EQ(with("dt = 0.01", "dt = 1e-20"),
            "gas.toml:22: run.dt: is 1e-20, which makes 1e+21 steps until run.t_end = 10; expected at most 2^53 = "
            "9.0072e+15");
  // A thermostat without dt kicks at every run.dt, in exact, too.
  const std::string bath = "thermostat = { kind = \"andersen\", temperature = 1.0, rate = 0.5 }";
  const std::string kicked = replaced(replaced(sound_scene, "restitution = 0.5", bath), "pairwise", "exact");
  EXPECT_THAT(complaint(replaced(kicked, "dt = 0.01", "dt = 1e-20")),
              HasSubstr("run.dt: is 1e-20, which makes 1e+21 kicks until"));
  EXPECT_THAT(with("[run]", "[output]\nevery = 1e-29\n[run]"),
              HasSubstr("21: output.every: is 1e-29, which makes 1e+30 frames until"));
  EXPECT_THAT(with("[run]", "[analysis]\nwhat = [\"speeds\"]\nevery = 1e-29\n[run]"),
              HasSubstr("22: analysis.every: is 1e-29, which makes 1e+30 samples until"));
  // The half periods of a vibration are counted in doubles, which must be exact integers.
  for (const char* shape : {"parabola", "sine"}) {
    const std::string motion =
        fmt::format("motion = {{ vibrate = [0, 1e-29], period = 1e-28, shape = \"{}\" }}", shape);
    EXPECT_THAT(with("[physics]", "bottom = { " + motion + " }\n[physics]"),
                HasSubstr("box.bottom.motion.period: is 1e-28, which makes 2e+29 half periods until run.t_end = 10; "
                          "expected at most"));
    EXPECT_THAT(with("[run]", "[[walls]]\nfrom = [1, 0.5]\nto = [2, 0.5]\n" + motion + "\n[run]"),
                HasSubstr("walls.0.motion.period: is 1e-28, which makes 2e+29 half periods"));
    // With 2^53 half periods the end of the last one cannot be represented.
    const std::string many =
        fmt::format("motion = {{ vibrate = [0, 1e-17], period = {}, shape = \"{}\" }}", 20.0 * 0x1p-53, shape);
    EXPECT_THAT(with("[physics]", "bottom = { " + many + " }\n[physics]"),
                HasSubstr("half periods until run.t_end = 10"));
  }
  EXPECT_THAT(with("maxwell = 1.0", "uniform = 1e20"),
              HasSubstr("16: disks.0.velocities: uniform = 1e+20 crosses the box"));
  EXPECT_THAT(with("restitution = 0.5", "gravity = 1e50"),
              HasSubstr("physics.gravity: is 1e+50: a disk that falls crosses"));
  EXPECT_THAT(with("restitution = 0.5", "diffusion = 1e50"),
              HasSubstr("physics.diffusion: is 1e+50: a disk in Brownian"));
  EXPECT_THAT(
      with("width = 20.0", "width = 1e13"),
      StartsWith("gas.toml:5: box.width: 10000000000000 is 1e+13 times the smallest radius, 1; expected at most 2^40"));
  EXPECT_EQ(with("width = 20.0", "width = 1e12"), "");
  EXPECT_THAT(complaint(sound_scene, {{"run.t_end", "1e29"}, {"run.method", "exact"}}),
              StartsWith("gas.toml:16: disks.0.velocities: maxwell = 1 "));
  EXPECT_THAT(complaint(sound_scene, {{"run.method", "auto"}, {"run.accuracy", "1e-300"}}), HasSubstr("run."));
}

TEST(Range, OfSources) {
  const auto source = [](std::string_view lines) {
    return complaint(replaced(sound_scene, "[run]", fmt::format("[[sources]]\n{}\nmass = 1\n[run]", lines)));
  };
  EXPECT_THAT(source("region = [1, 1, 9, 9]\nradius = 0.1\nrate = 1e300"),
              StartsWith("gas.toml:23: sources.0.rate: is 1e+300; expected a rate from 1e-30 to 1e+30"));
  EXPECT_THAT(source("region = [1, 1, 9, 9]\nradius = 0.1\nrate = 1e19\nlimit = 3"),
              StartsWith("gas.toml:23: sources.0.rate: is 1e+19: 1e+20 disks are due until run.t_end = 10; "
                         "expected at most 2^50"));
  EXPECT_EQ(source("region = [1, 1, 9, 9]\nradius = 0.1\nrate = 1e14\nlimit = 3"), "");
  constexpr std::string_view nowhere = "sources.0.region: has no place for the centre of a disk of radius 0.5";
  EXPECT_THAT(source("region = [0, 0, 0.4, 10]\nradius = 0.5\nrate = 1"), HasSubstr(std::string(nowhere)));
  EXPECT_THAT(source("region = [0, 0, 0.5, 10]\nradius = 0.5\nrate = 1"), HasSubstr(std::string(nowhere)));
  EXPECT_THAT(source("region = [4, 9.6, 6, 10]\nradius = { uniform = [0.1, 0.5] }\nrate = 1"),
              HasSubstr(std::string(nowhere)));
  EXPECT_EQ(source("region = [0.5, 5, 0.5, 5]\nradius = 0.5\nrate = 1"), "") << "a single place is enough";
  EXPECT_EQ(source("region = [0, 0, 0.6, 10]\nradius = 0.5\nrate = 1"), "");
}

using RangeOnTheCommandLine = test::CommandTest;

TEST_F(RangeOnTheCommandLine, IsNamedByTheOption) {
  for (const std::string command : {"run", "check"}) {
    expect_error("$C " + command + " small.toml --dt 1e-200", 2,
                 "--dt: is 1e-200; expected a time from 1e-30 to 1e+30");
    expect_error("$C " + command + " small.toml --dt 1e-20", 2,
                 "--dt: is 1e-20, which makes 1e+20 steps until run.t_end = 1");
    expect_error("$C " + command + " small.toml --t-end 1e155", 2, "--t-end: is 1e+155; expected a time");
    expect_error("$C " + command + " small.toml --set box.width=1e300", 2,
                 "--set box.width: is 1e+300; expected a length");
  }
  ASSERT_EQ(carom("run small.toml -o out --quiet --set output.checkpoint=3600").status, 0);
  expect_error("$C resume out --t-end 1e155", 2, "--t-end: is 1e+155; expected a time");
  expect_error("$C resume out --t-end 1e20", 2, "run.dt: is 0.01, which makes 1e+22 steps until run.t_end = 1e+20");
}

TEST(Title, IsOneThatFitsOnALine) {
  const std::string long_title(1001, 'x');
  EXPECT_EQ(with("\"gas\"", "\"" + long_title + "\""), "gas.toml:1: title: has 1001 characters; expected at most 1000");
  EXPECT_EQ(with("\"gas\"", "\"" + long_title.substr(1) + "\""), "");
  std::string umlauts;
  for (int k = 0; k < 1000; ++k) umlauts += "\u00fc";
  EXPECT_EQ(with("\"gas\"", "\"" + umlauts + "\""), "") << "characters, not bytes";
}

// Units that are powers of two, so that a scene in them has the same bits, scaled.
struct Powers {
  int length = 0, mass = 0, time = 0;
};

std::string number(double value, int power) {
  return fmt::format("{}", std::ldexp(value, power));
}

// Disks of several sizes under gravity that lose energy, between two walls and two periodic sides, with a source.
std::string busy_text(const Powers& p) {
  const auto length = [&](double x) { return number(x, p.length); };
  const auto mass = [&](double x) { return number(x, p.mass); };
  const auto time = [&](double x) { return number(x, p.time); };
  const auto speed = [&](double x) { return number(x, p.length - p.time); };
  const auto pair = [](const std::string& a, const std::string& b) { return fmt::format("[{}, {}]", a, b); };
  std::string text = fmt::format("[box]\nwidth = {}\nheight = {}\nleft = \"periodic\"\nright = \"periodic\"\n",
                                 length(12.0), length(9.0));
  text +=
      fmt::format("[physics]\ngravity = {}\nrestitution = 0.8\ncollapse = {{ model = \"tc\", contact_time = {} }}\n",
                  number(0.7, p.length - 2 * p.time), time(1e-3));
  text += fmt::format("[[disks]]\ncount = 3\npositions = [{}, {}, {}]\nvelocities = [{}, {}, {}]\n",
                      pair(length(2.0), length(3.0)), pair(length(7.0), length(3.1)), pair(length(10.0), length(6.0)),
                      pair(speed(3.0), speed(0.0)), pair(speed(-1.5), speed(0.3)), pair(speed(0.0), speed(-2.0)));
  text += fmt::format("radius = [{}, {}, {}]\nmass = [{}, {}, {}]\n", length(1.0), length(0.8), length(0.25), mass(2.0),
                      mass(1.0), mass(0.1));
  text += fmt::format(
      "[[disks]]\ncount = 2\npositions = [{}, {}]\nvelocities = {{ maxwell = {} }}\nradius = {}\nmass = {}\n",
      pair(length(4.5), length(7.5)), pair(length(7.0), length(7.5)), number(1.5, p.mass + 2 * (p.length - p.time)),
      length(0.5), mass(1.5));
  text +=
      fmt::format("[[sources]]\nside = \"top\"\nrate = {}\nradius = {}\nmass = {}\nvelocities = {{ uniform = {} }}\n",
                  number(2.0, -p.time), length(0.3), mass(0.5), speed(1.0));
  return text + fmt::format("[run]\nmethod = \"pairwise\"\ndt = {}\nt_end = {}\n", time(0.01), time(5.0));
}

// Only two disks that meet head-on.
std::string head_on_text(const Powers& p) {
  const auto length = [&](double x) { return number(x, p.length); };
  return fmt::format(
      "[box]\nwidth = {}\nheight = {}\n[[disks]]\ncount = 2\npositions = [[{}, {}], [{}, {}]]\nradius = {}\nmass = {}\n"
      "velocities = [[{}, 0], [0, 0]]\n[run]\nmethod = \"pairwise\"\ndt = {}\nt_end = {}\n",
      length(20.0), length(20.0), length(5.0), length(5.0), length(9.0), length(5.0), length(1.0), number(1.0, p.mass),
      number(1.0, p.length - p.time), number(0.1, p.time), number(3.0, p.time));
}

State end_of(const std::string& text, Method method, bool parallel) {
  Scene scene = test::scene_from(text);
  scene.run.method = method;
  State start = initial_state(scene);
  const auto engine =
      parallel ? make_parallel_engine(scene, std::move(start), {2}) : make_reference_engine(scene, std::move(start));
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

// Positions and velocities by id, the time, and the counters.
std::vector<double> figures_of(const State& state, const Powers& p) {
  std::vector<double> figures{std::ldexp(state.time, -p.time), static_cast<double>(state.counters.collisions),
                              static_cast<double>(state.counters.wall_collisions),
                              static_cast<double>(state.counters.emitted)};
  const Disks& d = state.disks;
  for (const std::size_t i : by_id(d)) {
    for (const double x : {d.x[i], d.y[i]}) figures.push_back(std::ldexp(x, -p.length));
    for (const double v : {d.vx[i], d.vy[i]}) figures.push_back(std::ldexp(v, p.time - p.length));
  }
  return figures;
}

// Over the whole ranges: the numbers of the texts above are between 2^-10 and 2^5.
std::vector<Powers> all_magnitudes(test::Draws& draws, int n) {
  std::vector<Powers> all{{95, 0, 0},  {-97, 0, 0},    {0, 160, 0},     {0, -160, 0},   {0, 0, 95},
                          {0, 0, -89}, {95, 160, -89}, {-97, -160, 95}, {95, -160, 95}, {-97, 160, -89}};
  for (int k = 0; k < n; ++k) {
    const auto in = [&](int low, int high) {
      return low + static_cast<int>(draws.bits() % static_cast<unsigned>(high - low));
    };
    all.push_back({in(-97, 96), in(-160, 161), in(-89, 96)});
  }
  return all;
}

void expect_same_at_all_magnitudes(std::string (*text)(const Powers&), int n) {
  test::Draws draws(1);
  const std::vector<Powers> all = all_magnitudes(draws, n);
  for (const Method method : {Method::rollback, Method::pairwise, Method::exact}) {
    const std::vector<double> right = figures_of(end_of(text({}), method, false), {});
    for (const Powers& p : all) {
      for (const bool parallel : {false, true}) {
        ASSERT_EQ(figures_of(end_of(text(p), method, parallel), p), right)
            << test::name_of(method) << (parallel ? ", parallel" : "") << " at 2^" << p.length << " lengths, 2^"
            << p.mass << " masses, 2^" << p.time << " times";
      }
    }
  }
}

TEST(Magnitude, HeadOnCollisionIsTheSameAtAll) {
  const State end = end_of(head_on_text({}), Method::exact, false);
  EXPECT_EQ(end.counters.collisions, 1U);
  EXPECT_EQ(end.disks.x[0], 7.0);
  EXPECT_EQ(end.disks.x[1], 10.0);
  expect_same_at_all_magnitudes(head_on_text, 60);
}

TEST(Magnitude, EverythingIsTheSameAtAll) {
  const State end = end_of(busy_text({}), Method::exact, false);
  EXPECT_GT(end.counters.collisions, 3U);
  EXPECT_GT(end.counters.emitted, 2U);
  expect_same_at_all_magnitudes(busy_text, 25);
}

// Any number of a scene may have any value: either it is refused in one line, or each method goes on with finite
// numbers, the same in both engines, or says that it cannot.
class AnyNumbers {
 public:
  explicit AnyNumbers(std::uint64_t seed) : draws_(seed) {}

  // The busy scene, in which each number may be replaced by an extreme one.
  std::string text() {
    std::string text =
        fmt::format("seed = {}\n[box]\nwidth = {}\nheight = {}\n", draws_.bits() % 1000, any(12.0), any(9.0));
    if (draws_.bits() % 2 == 0) text += "left = \"periodic\"\nright = \"periodic\"\n";
    text += "[physics]\n";
    if (draws_.bits() % 2 == 0) text += fmt::format("gravity = {}\n", any(0.7));
    if (draws_.bits() % 4 == 0) text += fmt::format("diffusion = {}\n", any(0.1));
    text += fmt::format(
        "[[disks]]\ncount = 3\npositions = [[2, 3], [7, 3], [10, {}]]\nvelocities = [[{}, 0], [-1, {}], [0, -2]]\n"
        "radius = [1, {}, 0.25]\nmass = [{}, 1, {}]\n",
        any(6.0), any(3.0), any(0.3), any(0.8), any(2.0), any(0.1));
    if (draws_.bits() % 3 == 0) {
      text += fmt::format("[[sources]]\nregion = [3, 5, 6, 8]\nrate = {}\nradius = {}\nmass = 1\n", any(2.0), any(0.3));
    }
    return text + fmt::format("[run]\nmethod = \"pairwise\"\ndt = {}\nt_end = {}\n", any(0.01), any(2.5));
  }

 private:
  std::string any(double sane) {
    constexpr int one_in = 12;
    if (draws_.bits() % one_in != 0) return fmt::format("{}", sane);
    const bool far = draws_.bits() % 2 == 0;
    return fmt::format("{}",
                       far ? std::pow(10.0, draws_.in(-307.0, 308.0)) : sane * std::pow(10.0, draws_.in(-8.0, 8.0)));
  }

  test::Draws draws_;
};

// The result of a run of some steps: its figures, or its error.
struct Course {
  std::vector<double> figures;
  std::string stopped;
  bool operator==(const Course&) const = default;
};

Course course_of(Scene scene, Method method, bool parallel) {
  constexpr int most_steps_tried = 60;
  scene.run.method = method;
  State start = initial_state(scene);
  Course course;
  const auto engine =
      parallel ? make_parallel_engine(scene, std::move(start), {2}) : make_reference_engine(scene, std::move(start));
  try {
    for (int k = 0; k < most_steps_tried && engine->state().time < scene.run.t_end; ++k) engine->step();
  } catch (const PhysicsError& error) {
    course.stopped = error.what();
    return course;
  }
  course.figures = figures_of(engine->state(), {});
  return course;
}

TEST(LongAnyNumber, IsRefusedOrRight) {
  int refused = 0;
  int ran = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const std::string text = AnyNumbers(seed).text();
    SCOPED_TRACE(text);
    const std::string message = complaint(text);
    if (!message.empty()) {
      EXPECT_THAT(message, AllOf(StartsWith("gas.toml:"), HasSubstr("; expected"), testing::Not(HasSubstr("\n"))));
      ++refused;
      continue;
    }
    ++ran;
    const Scene scene = test::scene_from(text);
    for (const Method method : {Method::rollback, Method::pairwise, Method::exact}) {
      const Course reference = course_of(scene, method, false);
      for (const double figure : reference.figures) ASSERT_TRUE(std::isfinite(figure)) << test::name_of(method);
      ASSERT_EQ(reference.figures, course_of(scene, method, true).figures) << test::name_of(method);
    }
  }
  EXPECT_GT(refused, 150);
  EXPECT_GT(ran, 300);
}

}  // namespace
}  // namespace carom
