// The table of a scene's keys: every row is read, its example is valid in a scene, its default is what holds without
// it; and docs/scene.md is what the program prints.
#include "core/scene/scene_keys.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <map>

#include "core/scene/scene_text.hpp"
#include "tests/support/program_support.hpp"
#include "tests/support/scene_support.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using testing::HasSubstr;

// It has a table for each kind of key, so that --set reaches all keys.
constexpr std::string_view full_scene = R"([box]
width = 100.0
height = 100.0
bottom = "periodic"
top = "periodic"
[physics]
collapse = { model = "tc", contact_time = 1e-6 }
[[physics.pairs]]
groups = ["tracer", "sources"]
restitution = 0.9
[[disks]]
name = "tracer"
count = 3
positions = "growth"
radius = 1.0
mass = 2.0
[[sources]]
region = [0.0, 0.0, 10.0, 5.0]
rate = 1.0
radius = 1.0
mass = 2.0
[[sources]]
side = "right"
rate = 1.0
radius = 1.0
mass = 2.0
[run]
method = "exact"
dt = 0.01
t_end = 10.0
[output]
trajectory = "h5md"
[analysis]
what = ["pair_correlation", "speeds", "density", "profile", "bond_correlation", "structure_factor"]
)";

SceneFrame three_disks(const FrameAsked&) {
  return {{{10.0, 10.0}, {20.0, 20.0}, {30.0, 30.0}}, {{0, 0}, {0, 0}, {0, 0}}, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};
}

std::string message_of(std::string_view text, const std::vector<Override>& changes, const std::string& folder = "") {
  try {
    parse_scene(text, "full.toml", folder, changes, three_disks);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// The table to which --set has to be applied: a table within a group is set as the value of one of the group's keys.
std::string owner_of(std::string_view table, std::string_view name) {
  if (table.empty()) return "";
  if (table == "disks" || table == "frame" || table.starts_with("disks.")) return "disks.0.";
  if (table == "box.side") return "box.left.";
  if (table == "box.side.motion") return "box.left.motion.";
  if (table == "physics.pairs") return "physics.pairs.0.";
  if (table == "walls.motion") return "walls.0.motion.";
  if (table == "walls") return name == "points" ? "walls.1." : "walls.0.";
  if (table == "sources") return name == "side" ? "sources.1." : "sources.0.";
  return std::string(table) + ".";
}

// With walls disks cannot grow.
std::string with_walls(std::string_view scene) {
  return test::replaced(test::replaced(scene, "positions = \"growth\"", "positions = \"random\""), "[run]",
                        "[[walls]]\nfrom = [50, 50]\nto = [60, 60]\n[[walls]]\npoints = [[70, 80], [75, 80]]\n[run]");
}

// With a thermostat there is no Brownian motion.
std::string with_thermostat(std::string_view scene) {
  return test::replaced(scene, "[physics]",
                        "[physics]\nthermostat = { kind = \"andersen\", temperature = 1, rate = 0.1, dt = 0.1 }");
}

// Is the key allowed only in scenes with rough disks?
bool wants_rough_disks(const SceneKey& key) {
  return key.table == "physics.roughness" || key.table == "box.wall_roughness" || key.name == "wall_roughness" ||
         key.name.starts_with("spin");
}

std::string with_rough_disks(std::string_view scene) {
  return test::replaced(scene, "[physics]", "[physics]\nroughness = { tangential_restitution = 0.5 }");
}

// A scene that contains this table.
std::string scene_for(const SceneKey& key) {
  if (wants_rough_disks(key)) return with_rough_disks(full_scene);
  if (key.table.starts_with("walls")) return with_walls(full_scene);
  if (key.table == "physics.thermostat") return with_thermostat(full_scene);
  return std::string(full_scene);
}

bool lies_in_a_value(const SceneKey& key) {
  return key.table == "frame" || key.table.starts_with("disks.");
}

std::string label(const SceneKey& key) {
  return fmt::format("[{}] {}", key.table, key.name);
}

// No key accepts a date, so an error shows that the key was read.
TEST(SceneKeys, EveryRowIsRead) {
  for (const SceneKey& key : scene_keys()) {
    Override change{owner_of(key.table, key.name) + std::string(key.name), "1979-05-27"};
    if (key.table == "box.side.motion" || key.table == "walls.motion") {
      const char* const other = key.name == "vibrate" ? "period = 1" : "velocity = [0, 0]";
      change = {key.table == "walls.motion" ? "walls.0.motion" : "box.left.motion",
                fmt::format("{{ {} = 1979-05-27{}{} }}", key.name, key.name == "velocity" ? "" : ", ",
                            key.name == "velocity" ? "" : other)};
    }
    if (key.table == "output.movie") {
      change = {"output.movie", fmt::format("{{ {} = 1979-05-27 }}", key.name)};
    }
    if (key.table == "frame") {
      const std::string frame = key.name == "frame" ? "" : "frame = \"out\", ";
      change = {"disks.0.positions", fmt::format("{{ {}{} = 1979-05-27 }}", frame, key.name)};
    } else if (lies_in_a_value(key)) {
      const std::string owner(key.table.substr(key.table.find('.') + 1));
      change = {"disks.0." + owner, fmt::format("{{ {} = 1979-05-27 }}", key.name)};
    }
    const std::string text = scene_for(key);
    const std::string message = message_of(text, {change});
    EXPECT_THAT(message, HasSubstr(std::string(key.name) + ":")) << label(key);
    EXPECT_THAT(message, HasSubstr("is a date or time")) << label(key);
  }
}

TEST(SceneKeys, EveryExampleIsAScenes) {
  const test::TestFolder folder("scene_keys_test");
  folder.write("p.csv", "10,10\n20,20\n30,30\n");
  folder.write("v.csv", "1,0\n0,1\n1,1\n");
  const std::map<std::string_view, std::vector<Override>> companions{
      {"left", {{"box.right", "periodic"}, {"sources.1.side", "top"}, {"box.bottom", "wall"}, {"box.top", "wall"}}},
      {"right", {{"box.left", "periodic"}, {"sources.1.side", "top"}, {"box.bottom", "wall"}, {"box.top", "wall"}}},
      {"bottom", {{"box.top", "wall"}, {"box.left", "periodic"}, {"box.right", "periodic"}, {"sources.1.side", "top"}}},
      {"top", {{"box.bottom", "wall"}, {"box.left", "periodic"}, {"box.right", "periodic"}, {"sources.1.side", "top"}}},
      {"accumulate", {{"physics.diffusion", "0.1"}}},
      {"region", {{"disks.0.positions", "random"}}},
      {"circle", {{"disks.0.positions", "random"}}},
  };
  for (const SceneKey& key : scene_keys()) {
    const std::size_t equals = key.example.find(" = ");
    if (equals == std::string_view::npos) continue;  // "[box]"
    std::string_view owner = key.table;
    if (owner.starts_with("analysis.")) owner = "analysis";
    if (owner == "output.movie") owner = "output";
    if (owner == "walls.motion") owner = "walls";
    if (owner == "box.side" || owner == "box.side.motion") owner = "box";
    if (owner == "physics.restitution" || owner == "physics.roughness") owner = "physics";
    if (owner == "box.wall_roughness") owner = "box";
    if (owner == "physics.collapse" || owner == "physics.thermostat") owner = "physics";
    std::vector<Override> changes{{owner_of(owner, key.name) + std::string(key.example.substr(0, equals)),
                                   std::string(key.example.substr(equals + 3))}};
    std::string text = scene_for(key);
    if (owner != "walls" && key.example.find("motion") != std::string_view::npos) {
      const std::size_t sources = text.find("[[sources]]");
      text.erase(sources, text.find("[run]") - sources);
      text = test::replaced(text, ", \"structure_factor\"", "");  // needs periodic sides
      text = test::replaced(text, "[\"tracer\", \"sources\"]", "[\"tracer\", \"tracer\"]");
      if (key.example.starts_with("bottom")) changes.push_back({"box.top", "wall"});
    }
    if (key.name == "packing_fraction" || key.name == "aspect") {
      text = test::replaced(text, "width = 100.0\nheight = 100.0", "packing_fraction = 0.1");
      changes.push_back({"sources.0.region", "[1, 1, 2, 2]"});
    }
    if (key.name == "shear_rate") {  // excludes most other keys
      text =
          "[box]\nwidth = 100.0\nheight = 100.0\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
          "top = \"periodic\"\n[[disks]]\ncount = 3\npositions = \"random\"\nradius = 1.0\nmass = 2.0\n"
          "[run]\nt_end = 10.0\n";
    }
    if (key.name == "fixed") {
      text = test::replaced(text, "positions = \"growth\"\nradius = 1.0\nmass = 2.0",
                            "positions = \"random\"\nradius = 1.0");
    }
    if (const auto more = companions.find(key.name); more != companions.end()) {
      changes.insert(changes.end(), more->second.begin(), more->second.end());
    }
    EXPECT_EQ(message_of(text, changes, folder.path().string()), "") << label(key) << ": " << key.example;
  }
}

// A key set to the default stated in its row changes nothing.
TEST(SceneKeys, EveryDefaultIsWhatHolds) {
  constexpr std::string_view bare = R"([box]
width = 100.0
height = 100.0
[[disks]]
count = 3
positions = "growth"
radius = 1.0
mass = 2.0
[run]
t_end = 10.0
[analysis]
what = ["pair_correlation", "speeds", "density", "profile"]
)";
  const std::string resolved = resolved_toml(parse_scene(bare, "bare.toml", ""));
  int seen = 0;
  for (const SceneKey& key : scene_keys()) {
    const bool value = !key.initial.empty() && (std::isdigit(static_cast<unsigned char>(key.initial.front())) != 0 ||
                                                key.initial.front() == '"' || key.initial.front() == '[' ||
                                                key.initial == "true" || key.initial == "false");
    if (!value || key.name == "aspect" || key.name == "precision" || key.name == "dimensions") continue;
    const Override change{owner_of(key.table, key.name) + std::string(key.name), std::string(key.initial)};
    if (key.name == "accumulate" || key.table == "box.side.motion" || key.table == "walls.motion") continue;
    if (key.table == "output.movie") {  // [output.movie] makes a movie by itself
      const Override movie{"output.movie", "{}"};
      EXPECT_EQ(resolved_toml(parse_scene(bare, "bare.toml", "", {movie, change})),
                resolved_toml(parse_scene(bare, "bare.toml", "", {movie})))
          << label(key);
      continue;
    }
    if (key.table == "physics.restitution") {
      const Override law{"physics.restitution", "{ viscoelastic = 0.1 }"};
      EXPECT_EQ(resolved_toml(parse_scene(bare, "bare.toml", "", {law, change})),
                resolved_toml(parse_scene(bare, "bare.toml", "", {law})))
          << label(key);
      continue;
    }
    if (key.table == "physics.roughness") {
      const Override rough{"physics.roughness", "{ tangential_restitution = 0.5 }"};
      EXPECT_EQ(resolved_toml(parse_scene(bare, "bare.toml", "", {rough, change})),
                resolved_toml(parse_scene(bare, "bare.toml", "", {rough})))
          << label(key);
      continue;
    }
    const std::string text(key.table == "walls" ? with_walls(bare) : bare);
    EXPECT_EQ(resolved_toml(parse_scene(text, "bare.toml", "", {change})),
              text == bare ? resolved : resolved_toml(parse_scene(text, "bare.toml", "")))
        << label(key);
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

TEST(SceneKeys, NamesAreUniqueAndTablesKnown) {
  for (const SceneKey& key : scene_keys()) {
    EXPECT_EQ(find_scene_key(key.table, key.name), &key) << label(key);
    const auto tables = scene_tables();
    EXPECT_TRUE(std::any_of(tables.begin(), tables.end(), [&](const SceneTable& t) { return t.name == key.table; }))
        << label(key);
    EXPECT_FALSE(key.meaning.empty()) << label(key);
  }
  EXPECT_EQ(table_of_path("disks.12.radius"), "disks.radius");
  EXPECT_EQ(table_of_path("sources.0"), "sources");
  EXPECT_EQ(table_of_path(""), "");
}

using ScenePage = test::ProgramTest;

TEST_F(ScenePage, IsWhatTheProgramPrints) {
  const test::Outcome printed = carom("docs scene");
  EXPECT_EQ(printed.status, 0);
  EXPECT_TRUE(printed.out == test::text_of(CAROM_SOURCE_DIR "/docs/scene.md"))
      << "a table has changed; write the page again with: carom docs scene > docs/scene.md";
  const test::Outcome wrong = carom("docs scenes");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("there is no page \"scenes\"; expected scene"));
}

}  // namespace
}  // namespace carom
