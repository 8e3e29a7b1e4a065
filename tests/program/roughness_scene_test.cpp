// Rough disks in a scene file: reading, writing and refusals, outputs, and scenes that start from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/measure/invariants.hpp"
#include "core/scene/scene_text.hpp"
#include "io/trajectory/scene_frame_reader.hpp"
#include "io/trajectory/trajectory_reader.hpp"
#include "tests/support/command_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::scene_from;
using test::sound_scene;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string rough(const std::string& roughness, const std::string& rest = "restitution = 0.5") {
  return replaced(sound_scene, "restitution = 0.5", rest + "\nroughness = " + roughness);
}

// The scene with a line for the disks, which is line 18.
std::string spinning(const std::string& spin) {
  return replaced(rough("{ tangential_restitution = 0.5 }"), "velocities =", spin + "\nvelocities =");
}

std::string walls(const std::string& roughness) {
  return replaced(rough("{ tangential_restitution = 0.5 }"), "left = ", "wall_roughness = " + roughness + "\nleft = ");
}

TEST(Roughness, IsReadAndWrittenAgain) {
  const std::string text =
      replaced(replaced(walls("{ tangential_restitution = -0.25, friction = 0.125 }"),
                        "velocities =", "spin = [1.0, -2.0, 0.5]\nvelocities ="),
               "{ tangential_restitution = 0.5 }", "{ tangential_restitution = 0.5, friction = 0.75, inertia = 0.4 }");
  const Scene scene = scene_from(text);
  const Surfaces surfaces = scene.physics.surfaces;
  EXPECT_EQ(surfaces, (Surfaces{0.4, {0.5, 0.75}, {-0.25, 0.125}}));
  EXPECT_THAT(initial_state(scene).disks.spin, testing::ElementsAre(1.0, -2.0, 0.5));
  const std::string resolved = resolved_toml(scene);
  const Scene again = parse_scene(resolved, "again.toml", "");
  EXPECT_EQ(resolved_toml(again), resolved);
  EXPECT_EQ(again.physics.surfaces, surfaces);
  EXPECT_EQ(initial_state(again).disks.spin, initial_state(scene).disks.spin);
}

TEST(Roughness, HasDefaults) {
  const Scene scene = scene_from(rough("{ tangential_restitution = 0.5 }"));
  EXPECT_EQ(scene.physics.surfaces, (Surfaces{0.5, {0.5, HUGE_VAL}, {-1.0, HUGE_VAL}}));
  EXPECT_FALSE(scene.physics.surfaces.walls.acts());
  EXPECT_THAT(initial_state(scene).disks.spin, testing::Each(0.0));
  EXPECT_FALSE(initial_state(scene_from(sound_scene)).disks.spins());
  EXPECT_THAT(resolved_toml(scene_from(sound_scene)), Not(HasSubstr("rough")));
}

TEST(SpinTemperature, IsExact) {
  const Scene scene = scene_from(spinning("spin_temperature = 3.0"));
  const Energy energy = energy_of(initial_state(scene).disks, 0.0);
  EXPECT_NEAR(2.0 * energy.rotational / 3.0, 3.0, 1e-14);
  const std::string resolved = resolved_toml(scene);
  EXPECT_EQ(initial_state(parse_scene(resolved, "again.toml", "")).disks.spin, initial_state(scene).disks.spin);
}

TEST(BadRoughness, OneLineEach) {
  EXPECT_THAT(complaint(rough("0.5")),
              StartsWith("gas.toml:12: physics.roughness: is a number; expected { tangential_rest"));
  EXPECT_THAT(complaint(rough("{ friction = 0.5 }")),
              StartsWith("gas.toml:12: physics.roughness.tangential_restitution: missing; expected b from -1"));
  EXPECT_THAT(complaint(rough("{ tangential_restitution = 1.5 }")),
              StartsWith("gas.toml:12: physics.roughness.tangential_restitution: is 1.5; expected b from -1"));
  EXPECT_THAT(complaint(rough("{ tangential_restitution = 0.5, friction = -0.1 }")),
              StartsWith("gas.toml:12: physics.roughness.friction: is -0.1; expected"));
  EXPECT_THAT(complaint(rough("{ tangential_restitution = 0.5, inertia = 0.0 }")),
              StartsWith("gas.toml:12: physics.roughness.inertia: is 0"));
  EXPECT_THAT(complaint(rough("{ tangential_restitution = 0.5, inertia = 1.5 }")),
              StartsWith("gas.toml:12: physics.roughness.inertia: is 1.5; expected I / (m r^2) from 1e-06 to 1"));
  EXPECT_THAT(complaint(rough("{ tangential_restitution = 0.5, fricton = 1 }")),
              AllOf(StartsWith("gas.toml:12: physics.roughness.fricton: unknown key"), HasSubstr("nearest: friction")));
  EXPECT_THAT(complaint(rough("{ tangential_restitution = 0.5 }", "diffusion = 0.5")),
              StartsWith("gas.toml:12: physics.roughness: cannot be used with physics.diffusion"));
  EXPECT_THAT(complaint(walls("{ tangential_restitution = -2.0 }")),
              StartsWith("gas.toml:7: box.wall_roughness.tangential_restitution: is -2"));
  EXPECT_THAT(complaint(walls("{ tangential_restitution = 0.5, inertia = 0.5 }")),
              StartsWith("gas.toml:7: box.wall_roughness.inertia: unknown key"));
  EXPECT_THAT(complaint(replaced(sound_scene, "left = ", "wall_roughness = { tangential_restitution = 0.5 }\nleft = ")),
              StartsWith("gas.toml:7: box.wall_roughness: cannot be used without physics.roughness"));
}

TEST(BadSpin, OneLineEach) {
  EXPECT_THAT(complaint(replaced(sound_scene, "velocities =", "spin = 1.0\nvelocities =")),
              StartsWith("gas.toml:16: disks.0.spin: cannot be used without physics.roughness"));
  EXPECT_THAT(complaint(replaced(sound_scene, "velocities =", "spin_temperature = 1.0\nvelocities =")),
              StartsWith("gas.toml:16: disks.0.spin_temperature: cannot be used without physics.roughness"));
  EXPECT_THAT(complaint(spinning("spin = [1.0, 2.0]")),
              StartsWith("gas.toml:17: disks.0.spin: has 2 entries for count = 3"));
  EXPECT_THAT(complaint(spinning("spin = []")), StartsWith("gas.toml:17: disks.0.spin: is an empty list"));
  EXPECT_THAT(complaint(spinning("spin = \"fast\"")), StartsWith("gas.toml:17: disks.0.spin: is a string; expected"));
  EXPECT_THAT(complaint(spinning("spin = 1e31")), StartsWith("gas.toml:17: disks.0.spin: is 1e+31; expected a rate"));
  EXPECT_THAT(complaint(spinning("spin = 1.0\nspin_temperature = 1.0")),
              StartsWith("gas.toml:18: disks.0.spin_temperature: cannot be used with spin"));
  EXPECT_THAT(complaint(spinning("spin_temperature = -1.0")),
              StartsWith("gas.toml:17: disks.0.spin_temperature: is -1"));
  EXPECT_THAT(complaint(spinning("spin = 1.0") + "[[disks]]\nfixed = true\ncount = 1\npositions = [[15, 5]]\n"
                                                 "radius = 1.0\nspin = 1.0\n"),
              HasSubstr("disks.1.spin: cannot be used with fixed = true"));
  EXPECT_THAT(complaint(spinning("spin = 1.0") + "[[sources]]\nside = \"top\"\nrate = 1.0\nradius = 0.5\nmass = 1.0\n"
                                                 "spin = [1.0]\n"),
              HasSubstr("sources.0.spin: is a list"));
}

class RoughRun : public test::CommandTest {
 protected:
  void SetUp() override {
    const std::string text = replaced(
        replaced(test::small_scene, "[[disks]]", "[physics]\nroughness = { tangential_restitution = 0.5 }\n[[disks]]"),
        "radius = 0.5", "spin_temperature = 1.0\nradius = 0.5");
    write("rough.toml", replaced(text, "count = 5", "count = 40"));
  }
};

TEST_F(RoughRun, ShowsSpinsInBothTrajectoriesAndTheirEnergyInTheSeries) {
  ASSERT_EQ(carom("run rough.toml -o xyz --quiet").status, 0);
  ASSERT_EQ(carom("run rough.toml -o h5 --quiet --set output.trajectory=h5md").status, 0);
  EXPECT_THAT(test::text_of(at("xyz/trajectory.xyz")), HasSubstr(":spin:R:1 Time="));
  EXPECT_THAT(test::text_of(at("xyz/series.csv")), HasSubstr(",force_top,rotational,rotational_temperature\n"));
  const auto a = open_trajectory(at("xyz/trajectory.xyz").string());
  const auto b = open_trajectory(at("h5/trajectory.h5").string());
  TrajectoryFrame first, second;
  int frames = 0;
  for (; a->read(first); ++frames) {
    ASSERT_TRUE(b->read(second));
    ASSERT_EQ(first.disks.spin.size(), 40U);
    EXPECT_EQ(first.disks.spin, second.disks.spin);
  }
  EXPECT_EQ(frames, 11);
  EXPECT_EQ(carom("compare xyz/trajectory.xyz h5/trajectory.h5").status, 0);
  const SceneFrame last = read_scene_frame({at("h5").string(), {}, {}});
  EXPECT_EQ(last.spin, first.disks.spin);
}

TEST_F(RoughRun, GoesOnFromAFrameWithItsSpins) {
  ASSERT_EQ(carom("run rough.toml -o first --quiet").status, 0);
  const SceneFrame last = read_scene_frame({at("first").string(), {}, {}});
  std::string text =
      replaced(test::text_of(at("rough.toml")), "spin_temperature = 1.0", "spin = { frame = \"first\" }");
  text = replaced(text, "positions = \"random\"", "positions = { frame = \"first\" }");
  write("second.toml", text);
  ASSERT_EQ(carom("run second.toml -o second --quiet").status, 0);
  const SceneFrame begun = read_scene_frame({at("second").string(), 1, {}});
  EXPECT_EQ(begun.spin, last.spin);
}

TEST_F(RoughRun, IsToldByCheck) {
  EXPECT_THAT(carom("check rough.toml").out, HasSubstr("; rough disks: restitution 0.5 along surfaces"));
  EXPECT_THAT(carom("check rough.toml --set physics.roughness.friction=0.25 --set "
                    "box.wall_roughness='{ tangential_restitution = 0.75 }'")
                  .out,
              HasSubstr("restitution 0.5 along surfaces, friction 0.25 (walls: 0.75 along surfaces)"));
  EXPECT_THAT(carom("check small.toml").out, Not(HasSubstr("rough")));
}

// Couette's flow with a wall that is smooth by mistake: nothing moves, and nothing else would say why.
TEST_F(RoughRun, CheckSaysThatASmoothWallDragsNothing) {
  const auto check = [&](const std::string& box, const std::string& physics, const std::string& points) {
    write("s.toml", "[box]\nwidth = 10.0\nheight = 10.0\nleft = \"periodic\"\nright = \"periodic\"\n" + box +
                        "[physics]\n" + physics + "[[walls]]\npoints = " + points +
                        "\nmotion = { velocity = [1.0, 0.0] }\n[[disks]]\ncount = 1\npositions = [[5.0, 5.0]]\n"
                        "radius = 0.5\nmass = 1.0\n[run]\nt_end = 1.0\n");
    return carom("check s.toml").out;
  };
  const std::string rough_disks = "roughness = { tangential_restitution = 0.5 }\n";
  const auto trouble = HasSubstr("walls.0 moves along itself but is smooth");
  EXPECT_THAT(check("", "", "[[0.0, 1.0], [10.0, 1.0]]"), trouble);
  EXPECT_THAT(check("", rough_disks, "[[10.0, 1.0], [0.0, 1.0]]"), trouble);
  EXPECT_THAT(check("wall_roughness = { tangential_restitution = 0.5 }\n", rough_disks, "[[0.0, 1.0], [10.0, 1.0]]"),
              Not(trouble));
  EXPECT_THAT(check("", "", "[[0.0, 1.0], [9.0, 1.0]]"), Not(trouble)) << "a gate that moves";
  EXPECT_THAT(check("", "", "[[0.0, 1.0], [10.0, 2.0]]"), Not(trouble));
}

TEST_F(RoughRun, ComparesSpins) {
  ASSERT_EQ(carom("run rough.toml -o a --quiet").status, 0);
  write("other.toml", replaced(test::text_of(at("rough.toml")), "spin_temperature = 1.0", "spin = 1.0"));
  ASSERT_EQ(carom("run other.toml -o b --quiet --set run.t_end=0").status, 0);
  const test::Outcome o = carom("compare a b --at 0 --fields spin");
  EXPECT_NE(o.status, 0);
  EXPECT_THAT(o.out + o.err, HasSubstr("spin"));
  EXPECT_EQ(carom("compare a b --at 0 --fields x,y,vx,vy").status, 0);
}

}  // namespace
}  // namespace carom
