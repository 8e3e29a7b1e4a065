// Reading valid scenes: defaults, every law, overrides, and the resolved scene, which gives the same scene again.
#include "core/load/scene_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "core/disks/state_hash.hpp"
#include "core/scene/scene_text.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/scene_support.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using test::Draws;
using test::replaced;
using test::scene_from;
using test::sound_scene;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view least_scene = R"(
[box]
width = 20
height = 10
[[disks]]
count = 2
positions = "square"
radius = 1
mass = 2
[run]
t_end = 3
)";

// A backslash at the end of a line removes the white space after it, and no other character.
TEST(SceneFile, StringsGoOnAfterABackslashWithAnyCharacter) {
  for (const std::string_view c : {"\u00a7", "\u00e9", "\u1e9e", "\u3042", "\ufb4b", "\ufdbf", "\ufe0f"}) {
    const Scene s = scene_from(fmt::format("title = \"\"\"a\\\n  {}\"\"\"\n{}", c, least_scene));
    EXPECT_EQ(s.title, fmt::format("a{}", c));
  }
}

TEST(SceneFile, AbsentKeysHaveTheirDefaults) {
  const Scene s = scene_from(least_scene);
  EXPECT_EQ(s.title, "");
  EXPECT_EQ(s.file, "gas.toml");
  EXPECT_EQ(s.seed, 1U);
  EXPECT_THAT(s.box.sides, testing::Each(SideKind::wall));
  EXPECT_EQ(s.box.restitutions, (std::array{1.0, 1.0, 1.0, 1.0}));
  EXPECT_EQ(s.physics.gravity, 0.0);
  EXPECT_EQ(s.physics.restitution, 1.0);
  EXPECT_EQ(s.physics.diffusion, 0.0);
  EXPECT_FALSE(s.physics.accumulate);
  EXPECT_FALSE(s.physics.collapse_contact_time.has_value());
  EXPECT_EQ(s.groups[0].velocities.kind, VelocityLaw::Kind::rest);
  EXPECT_EQ(s.groups[0].line, 5);
  EXPECT_EQ(s.run.method, Method::exact);
  EXPECT_EQ(s.run.dt, 0.0);
  EXPECT_EQ(s.output.every, 0.0);
  EXPECT_EQ(s.output.trajectory, TrajectoryFormat::none);
  EXPECT_TRUE(s.output.plots.empty());
}

TEST(SceneFile, FramesDefaultToAHundredthOfTheRun) {
  for (const char* line : {"series = true", "movie = true", "trajectory = \"xyz\"", "plots = [\"energy\"]"}) {
    EXPECT_EQ(scene_from(fmt::format("{}[output]\n{}", least_scene, line)).output.every, 0.03) << line;
  }
  EXPECT_EQ(scene_from(fmt::format("{}[output]\nseries = true\nevery = 0.5", least_scene)).output.every, 0.5);
  EXPECT_EQ(scene_from(fmt::format("{}[output]\nseries = false", least_scene)).output.every, 0.0);
}

TEST(SceneFile, ReadsGravityAsANumberOrAVector) {
  const auto gravity = [](const std::string& value) {
    return scene_from("[box]\nwidth = 9\nheight = 9\n[physics]\ngravity = " + value + "\n[run]\nt_end = 1\n" +
                      "[[disks]]\ncount = 1\npositions = [[3, 4]]\nradius = 1\nmass = 1\n")
        .physics.gravity;
  };
  EXPECT_EQ(gravity("0.5"), Gravity(0.0, 0.5));
  EXPECT_EQ(gravity("[0, -0.5]"), gravity("0.5"));
  EXPECT_FALSE(std::signbit(gravity("[0, -0.5]").left)) << "the sign of a zero would show in velocities";
  EXPECT_EQ(gravity("[0.0, 0]"), gravity("0"));
  EXPECT_EQ(gravity("[3, -4]"), Gravity(-3.0, 4.0));
  EXPECT_EQ(gravity("[3, -4]").size, 5.0);
  EXPECT_EQ(gravity("[0, 2]").size, 2.0);
}

TEST(ResolvedScene, KeepsGravityThatPointsUp) {
  Scene s = scene_from(least_scene);
  for (const Gravity& g : {Gravity(0.0, -2.0), Gravity(-3.0, 0.0), Gravity(0.0, 2.0)}) {
    s.physics.gravity = g;
    EXPECT_EQ(scene_from(resolved_toml(s)).physics.gravity, g) << g.left << ' ' << g.down;
  }
}

constexpr std::string_view every_key = R"(
title = "all"
seed = 12
[box]
width = 20.5
height = 10
left = "sink"
bottom = "periodic"
top = "periodic"
wall_restitution = 0.9
[physics]
gravity = 0.5
restitution = 0.25
diffusion = 0.125
accumulate = true
collapse = { model = "tc", contact_time = 1e-6 }
[[disks]]
count = 0
positions = "hexagonal"
radius = { uniform = [0.5, 1] }
mass = { from_radius = 3 }
[[disks]]
count = 2
positions = [[3, 4], [6, 7.5]]
velocities = [[1, -1], [0.5, 0]]
radius = { from_mass = 0.5 }
mass = [1, 2]
[[sources]]
region = [1, 2, 3, 4]
rate = 10
radius = 0.5
mass = { uniform = [1, 2] }
velocities = { uniform = 2 }
limit = 100
[[sources]]
side = "right"
rate = 1
radius = 0.5
mass = 1
velocities = { maxwell = 2 }
[run]
method = "rollback"
dt = 0.5
t_end = 0
[output]
trajectory = "h5md"
plots = ["energy", "velocity", "energy"]
)";

TEST(SceneFile, ReadsEveryKey) {
  const Scene s = scene_from(every_key);
  EXPECT_EQ(s.box.side(Side::left), SideKind::sink);
  EXPECT_EQ(s.box.side(Side::right), SideKind::wall);
  EXPECT_TRUE(s.box.periodic_y());
  EXPECT_EQ(s.box.width, 20.5);
  EXPECT_EQ(s.physics.collapse_contact_time, 1e-6);
  EXPECT_TRUE(s.physics.accumulate);
  EXPECT_EQ(s.groups[0].mass.density, 3.0);
  EXPECT_EQ(s.groups[1].radius.kind, SizeLaw::Kind::from_other);
  EXPECT_THAT(s.groups[1].positions.list, ElementsAre(Vec2{3, 4}, Vec2{6, 7.5}));
  EXPECT_THAT(s.groups[1].mass.values, ElementsAre(1, 2));
  EXPECT_EQ(s.sources[0].limit, 100U);
  EXPECT_EQ(s.sources[0].region_high, (Vec2{3, 4}));
  EXPECT_EQ(s.sources[1].side, Side::right);
  EXPECT_EQ(s.sources[1].velocities.temperature, 2.0);
  EXPECT_EQ(s.run.method, Method::rollback);
  EXPECT_EQ(s.run.t_end, 0.0);
  EXPECT_THAT(s.output.plots, ElementsAre("energy", "velocity"));
}

TEST(SceneFile, SeedsUpTo64Bits) {
  for (const std::uint64_t seed : {0ULL, 1ULL, 9223372036854775807ULL, 9223372036854775808ULL, ~0ULL}) {
    const Scene s = scene_from(fmt::format("title = \"x\"\n  seed = {} # large\n{}", seed, least_scene));
    EXPECT_EQ(s.seed, seed);
    EXPECT_EQ(scene_from(fmt::format("seed = \"{}\"\n{}", seed, least_scene)).seed, seed);
    EXPECT_EQ(scene_from(least_scene, {{"seed", fmt::format("{}", seed)}}).seed, seed);
    EXPECT_EQ(scene_from(resolved_toml(s)).seed, seed);
  }
}

TEST(Overrides, ReplaceAndAdd) {
  const Scene s = scene_from(least_scene, {{"physics.restitution", "0.5"},
                                           {"run.method", "rollback"},
                                           {"run.dt", "0.25"},
                                           {"disks.0.count", "3"},
                                           {"disks.0.positions", "[[1, 1], [4, 4], [8, 8]]"},
                                           {"disks.0.positions.1", "[5, 5]"},
                                           {"title", "\"two words\""},
                                           {"output.movie", "true"},
                                           {"run.dt", "0.125"}});
  EXPECT_EQ(s.physics.restitution, 0.5);
  EXPECT_EQ(s.run.method, Method::rollback);
  EXPECT_EQ(s.run.dt, 0.125) << "the last override counts";
  EXPECT_EQ(s.groups[0].count, 3U);
  EXPECT_EQ(s.groups[0].positions.list[1], (Vec2{5, 5}));
  EXPECT_EQ(s.title, "two words");
  EXPECT_TRUE(s.output.movie);
}

TEST(PackingFraction, GivesTheBox) {
  const std::string text =
      replaced(least_scene, "width = 20\nheight = 10", "packing_fraction = 0.25\naspect = 4\nleft = \"wall\"");
  const Scene s = scene_from(text);
  EXPECT_DOUBLE_EQ(s.box.width, 4 * s.box.height);
  EXPECT_DOUBLE_EQ(2 * std::numbers::pi / (s.box.width * s.box.height), 0.25);
  const Scene drawn = scene_from(text, {{"disks.0.radius", "{ uniform = [1, 2] }"}, {"disks.0.count", "50"}});
  std::vector<double> radii;
  std::vector<double> masses;
  draw_sizes(drawn, drawn.groups[0], 0, radii, masses);
  double area = 0.0;
  for (const double r : radii) area += std::numbers::pi * r * r;
  EXPECT_DOUBLE_EQ(area / (drawn.box.width * drawn.box.height), 0.25);
}

TEST(SceneFile, FindsCsvBesideTheScene) {
  const test::TestFolder folder("scene_file_test");
  folder.write("p.csv", "x,y\n3,4\n6,7.5\n");
  const std::string path = folder.write(
      "s.toml", replaced(least_scene, "\"square\"", "{ file = \"p.csv\" }\nvelocities = { file = \"p.csv\" }"));
  const Scene s = load_scene(path);
  EXPECT_EQ(s.file, path);
  EXPECT_THAT(s.groups[0].positions.list, ElementsAre(Vec2{3, 4}, Vec2{6, 7.5}));
  EXPECT_THAT(s.groups[0].velocities.list, ElementsAre(Vec2{3, 4}, Vec2{6, 7.5}));
  EXPECT_EQ(s.groups[0].positions.file, "p.csv");
  EXPECT_EQ(resolved_toml(scene_from(resolved_toml(s))), resolved_toml(s)) << "the CSV file is no longer needed";
}

// Outputs that are not used are not written out. If the time between frames were, anyone who adds an output to the
// scene.toml of a run without frames would get a hundred frames.
TEST(ResolvedScene, HasATimeBetweenFramesOnlyWhereThereAreAny) {
  const std::string ten = replaced(least_scene, "t_end = 3", "t_end = 10");
  const std::string none = resolved_toml(scene_from(ten));
  EXPECT_THAT(none, Not(HasSubstr("every")));
  EXPECT_EQ(scene_from(none, {{"output.series", "true"}}).output.every, 0.1);
  EXPECT_THAT(resolved_toml(scene_from(ten, {{"output.every", "2.5"}})), HasSubstr("every = 2.5\n"));
  const std::string ends = resolved_toml(scene_from(ten, {{"output.series", "true"}, {"output.every", "0"}}));
  EXPECT_THAT(ends, HasSubstr("every = 0.0\n")) << "frames at the start and at the end";
}

TEST(ResolvedScene, KeepsOddTitlesAndNumbers) {
  Scene s = scene_from(least_scene);
  s.title = "quote \" backslash \\ tab \t line \n bell \a delete \x7f é";
  s.groups[0].velocities.kind = VelocityLaw::Kind::list;
  s.groups[0].velocities.list = {{-0.0, 1.2345678901234567e15}, {5e-324, 0.1 + 0.2}};
  const Scene again = scene_from(resolved_toml(s));
  EXPECT_EQ(again.title, s.title);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec2 a = s.groups[0].velocities.list[k];
    const Vec2 b = again.groups[0].velocities.list[k];
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.x), std::bit_cast<std::uint64_t>(b.x));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.y), std::bit_cast<std::uint64_t>(b.y));
  }
}

// A random law for a radius or mass. other: the key from which it may be derived; empty for none.
std::string random_size(Draws& draws, Count count, std::string_view other) {
  switch (draws.bits() % (other.empty() ? 3 : 4)) {
    case 0:
      return fmt::format("{:.17g}", draws.in(0.1, 0.5));
    case 1: {
      const double low = draws.in(0.1, 0.3);
      return fmt::format("{{ uniform = [{:.17g}, {:.17g}] }}", low, low + draws.in(0, 0.2));
    }
    case 2: {
      std::vector<double> values;
      for (Count k = 0; k < count; ++k) values.push_back(draws.in(0.1, 0.5));
      return fmt::format("[{:.17g}]", fmt::join(values, ", "));
    }
    default:
      return fmt::format("{{ {} = {:.17g} }}", other, draws.in(0.5, 5.0));
  }
}

std::string random_velocities(Draws& draws, Count count) {
  switch (draws.bits() % 4) {
    case 0:
      return "";
    case 1:
      return fmt::format("velocities = {{ uniform = {:.17g} }}\n", draws.decades(1e-3, 1e3));
    case 2:
      return fmt::format("velocities = {{ maxwell = {:.17g} }}\n", count == 1 ? 0.0 : draws.decades(1e-3, 1e3));
    default: {
      std::string list;
      for (Count k = 0; k < count; ++k) list += fmt::format("[{:.17g}, {:.17g}],", draws.in(-1, 1), draws.in(-1, 1));
      return fmt::format("velocities = [{}]\n", list);
    }
  }
}

std::string random_scene(Draws& draws) {
  const char* periodic = draws.bits() % 2 == 0 ? "wall" : "periodic";
  std::string text = fmt::format("seed = {}\n[box]\npacking_fraction = {:.17g}\naspect = {:.17g}\nleft = \"{}\"\n",
                                 draws.bits(), draws.in(0.01, 0.1), draws.in(0.5, 2), periodic);
  const std::string gravity = draws.bits() % 2 == 0
                                  ? fmt::format("{:.17g}", draws.in(0, 1))
                                  : fmt::format("[{:.17g}, {:.17g}]", draws.in(-1, 1), draws.in(-1, 1));
  text += fmt::format("right = \"{}\"\ntop = \"sink\"\n[physics]\ngravity = {}\nrestitution = {:.17g}\n", periodic,
                      gravity, draws.in(0, 1));
  for (std::uint64_t g = 0; g < 1 + draws.bits() % 3; ++g) {
    const Count count = 5 + draws.bits() % 30;
    text += fmt::format("[[disks]]\ncount = {}\npositions = \"random\"\n{}", count, random_velocities(draws, count));
    const bool from_mass = draws.bits() % 2 == 0;
    text += fmt::format("radius = {}\n", random_size(draws, count, from_mass ? "from_mass" : ""));
    text += fmt::format("mass = {}\n", random_size(draws, count, from_mass ? "" : "from_radius"));
  }
  return text + fmt::format("[run]\nt_end = {:.17g}\ndt = {:.17g}\n", draws.in(0, 100), draws.decades(1e-9, 1));
}

TEST(ResolvedScene, GivesTheSameSceneAndTheSameStart) {
  Draws draws(11);
  for (int k = 0; k < 200; ++k) {
    const std::string text = random_scene(draws);
    SCOPED_TRACE(text);
    const Scene scene = scene_from(text);
    const std::string resolved = resolved_toml(scene);
    const Scene again = scene_from(resolved);
    EXPECT_EQ(resolved_toml(again), resolved);
    const State a = initial_state(scene);
    const State b = initial_state(again);
    EXPECT_EQ(scene.physics.gravity, again.physics.gravity);
    EXPECT_EQ(state_hash(a.disks), state_hash(b.disks));
    EXPECT_EQ(a.disks.radius, b.disks.radius);
    EXPECT_EQ(a.disks.mass, b.disks.mass);
    EXPECT_EQ(a.disks.common_radius, b.disks.common_radius);
  }
}

// A scene's text with any damage is read or refused, and nothing else happens.
TEST(SceneFile, SpoiltTextIsReadOrRefused) {
  Draws draws(12);
  for (int k = 0; k < 3000; ++k) {
    std::string text = k % 2 == 0 ? std::string(sound_scene) : random_scene(draws);
    for (std::uint64_t n = 1 + draws.bits() % 3; n > 0; --n) {
      const std::size_t at = draws.bits() % text.size();
      if (draws.bits() % 2 == 0) {
        text[at] = static_cast<char>(draws.bits() % 256);
      } else {
        text.erase(at, 1 + draws.bits() % 4);
      }
    }
    try {
      scene_from(text);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
      EXPECT_THAT(error.what(), testing::StartsWith("gas.toml:"));
    }
  }
}

TEST(SceneFile, OurOwnScenesAreSound) {
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CAROM_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = load_scene(entry.path().string());
    Count count = 0;
    Count fixed = 0;
    for (const DiskGroup& group : scene.groups) (group.fixed ? fixed : count) += group.count;
    for (const InnerWall& wall : scene.walls) fixed += wall.points.size() - 1;  // one for each segment
    EXPECT_GT(count + scene.sources.size(), 0U) << entry.path();
    // Placing a million disks takes seconds, and much longer with a sanitizer.
    if (count <= 100'000) {
      const State start = initial_state(scene);
      EXPECT_EQ(start.disks.size(), count) << entry.path();
      EXPECT_EQ(start.obstacles.size(), fixed) << entry.path();
    }
    ++scenes;
  }
  EXPECT_GE(scenes, 5U);
}

// An inner wall without a restitution of its own has that of the walls of the box.
TEST(SceneFile, InnerWallsHaveTheRestitutionOfWalls) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 20\nheight = 10\nwall_restitution = 0.5\n[[walls]]\nfrom = [5, 2]\nto = [5, 8]\n[[walls]]\n"
      "from = [9, 2]\nto = [9, 8]\nrestitution = 0.75\n[[walls]]\nfrom = [12, 2]\nto = [12, 8]\nkind = \"sink\"\n"
      "[[disks]]\ncount = 0\npositions = \"random\"\nradius = 0.5\nmass = 1\n[run]\nmethod = \"exact\"\nt_end = 1\n",
      "walls", "");
  ASSERT_EQ(scene.walls.size(), 3U);
  EXPECT_EQ(scene.walls[0].restitution, 0.5);
  EXPECT_EQ(scene.walls[1].restitution, 0.75);
  EXPECT_TRUE(scene.walls[2].sink);
}

}  // namespace
}  // namespace carom
