#include "core/load/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/base/duration.hpp"
#include "core/base/float_environment.hpp"
#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/load/box_check.hpp"
#include "core/load/densest_packing.hpp"
#include "core/load/method_choice.hpp"
#include "core/load/moving_side_check.hpp"
#include "core/load/scene_check.hpp"
#include "core/scene/scene_analysis.hpp"
#include "core/scene/scene_group_name.hpp"
#include "core/scene/scene_laws.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_output.hpp"
#include "core/scene/scene_override.hpp"
#include "core/scene/scene_range_check.hpp"
#include "core/scene/scene_ranges.hpp"
#include "core/scene/scene_reader.hpp"
#include "core/scene/scene_restitution.hpp"
#include "core/scene/scene_roughness.hpp"
#include "core/scene/scene_sides.hpp"
#include "core/scene/scene_thermostat.hpp"
#include "core/scene/scene_tree.hpp"
#include "core/scene/scene_walls.hpp"
#include "core/scene/size_law.hpp"

namespace carom {

namespace {

// The table under a name of the root, or nullptr. Throws InputError if the name holds something else.
const toml::table* section(const SceneOrigin& origin, std::string_view name) {
  const toml::node* node = origin.root->get(name);
  if (node == nullptr || node->is_table()) return node == nullptr ? nullptr : node->as_table();
  origin.fail(name, fmt::format("is {}", type_name(*node)), fmt::format("expected a table [{}]", name));
}

const toml::table& required_section(const SceneOrigin& origin, std::string_view name, std::string_view keys) {
  const toml::table* table = section(origin, name);
  if (table == nullptr) origin.fail(name, "missing", fmt::format("expected a table [{}] with {}", name, keys));
  return *table;
}

std::uint64_t read_seed(const TableReader& root) {
  constexpr std::string_view expected = "expected a whole number from 0 to 18446744073709551615";
  const toml::node* node = root.find("seed");
  if (node == nullptr) return 1;
  if (!node->is_string()) {
    if (!node->is_integer()) root.fail("seed", fmt::format("is {}", type_name(*node)), expected);
    const std::int64_t value = node->as_integer()->get();
    if (value < 0) root.fail("seed", fmt::format("is {}", value), expected);
    return static_cast<std::uint64_t>(value);
  }
  const std::string text = root.text("seed").value();
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) {
    root.fail("seed", fmt::format("is {}", in_quotes(text)), expected);
  }
  return seed;
}

// The title must fit on one line of pictures, files and messages.
std::string read_title(const TableReader& root) {
  constexpr std::ptrdiff_t longest = 1000;
  std::string title = root.text("title").value_or("");
  // Counts the bytes that begin a character of UTF-8.
  const auto characters =
      std::count_if(title.begin(), title.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80; });
  if (characters > longest) {
    root.fail("title", fmt::format("has {} characters", characters), fmt::format("expected at most {}", longest));
  }
  return title;
}

// The size of the box as the scene gives it: both lengths, or a packing fraction with an aspect.
struct BoxSize {
  std::optional<double> width, height, packing_fraction, aspect;
};

BoxSize read_box(const SceneOrigin& origin, Scene& scene) {
  const TableReader reader(origin, "box", required_section(origin, "box", "width and height"));
  read_sides(reader, scene);
  const BoxSize size{reader.number("width"), reader.number("height"), reader.number("packing_fraction"),
                     reader.number("aspect")};
  if (size.packing_fraction) {
    if (size.width || size.height) {
      reader.fail("packing_fraction", fmt::format("cannot be used with {}", size.width ? "width" : "height"),
                  "expected either width and height, or packing_fraction");
    }
    if (*size.packing_fraction >= densest_packing) {
      reader.fail("packing_fraction", fmt::format("is {}", *size.packing_fraction),
                  "expected a number below pi / sqrt(12) = 0.9069, the densest packing");
    }
    return size;
  }
  if (size.aspect) reader.fail("aspect", "cannot be used without packing_fraction", "expected only width and height");
  if (!size.width) reader.fail("width", "missing", "expected a length above 0");
  if (!size.height) reader.fail("height", "missing", "expected a length above 0");
  return size;
}

// A number is gravity downwards, a list the vector.
Gravity read_gravity(const TableReader& physics) {
  const toml::node* node = physics.find("gravity");
  if (node == nullptr || !node->is_array()) return physics.number_or_initial("gravity");
  const std::vector<double> g = as_numbers(physics.origin(), physics.key("gravity"), *node);
  if (g.size() != 2) {
    physics.fail("gravity", "has " + counted(g.size(), "number"), "expected a number, or [gx, gy]");
  }
  for (const double part : g) {
    if (!in_range(Dimension::acceleration, part)) {
      physics.fail("gravity", fmt::format("is [{}, {}]", g[0], g[1]), expected_range(Dimension::acceleration));
    }
  }
  return {0.0 - g[0], 0.0 - g[1]};  // no zero with a sign
}

Physics read_physics(const SceneOrigin& origin) {
  Physics physics;
  const toml::table* table = section(origin, "physics");
  if (table == nullptr) return physics;
  const TableReader reader(origin, "physics", *table);
  physics.gravity = read_gravity(reader);
  physics.diffusion = reader.number("diffusion").value_or(0.0);
  physics.accumulate = reader.flag_or_initial("accumulate");
  physics.thermostat = read_thermostat(reader);
  const toml::node* node = reader.find("collapse");
  if (node == nullptr) return physics;
  constexpr std::string_view expected = "expected { model = \"tc\", contact_time = t }";
  const toml::table* collapse = node->as_table();
  if (collapse == nullptr) reader.fail("collapse", fmt::format("is {}", type_name(*node)), expected);
  const TableReader remedy(origin, "physics.collapse", *collapse);
  if (!remedy.choice("model")) remedy.fail("model", "missing", expected);
  physics.collapse_contact_time = remedy.number("contact_time");
  if (!physics.collapse_contact_time) remedy.fail("contact_time", "missing", expected);
  return physics;
}

// Rejects keys that fixed disks do not have. Their mass, which nothing uses, is 1.
void read_fixed(const TableReader& reader, DiskGroup& group) {
  constexpr std::string_view expected = "expected fixed disks without this key";
  if (reader.find("mass") != nullptr)
    reader.fail("mass", "cannot be used with fixed = true, which is an infinite mass", expected);
  for (const std::string_view key : {"velocities", "drift", "spin", "spin_temperature"}) {
    if (reader.find(key) != nullptr) reader.fail(key, "cannot be used with fixed = true", expected);
  }
  if (group.radius.kind == SizeLaw::Kind::from_other) {
    reader.fail("radius", "from_mass cannot be used with fixed = true", "expected radii that need no mass");
  }
  group.mass.value = 1.0;
}

DiskGroup read_group(const SceneOrigin& origin, const std::string& path, const toml::table& table) {
  const TableReader reader(origin, path, table);
  DiskGroup group;
  group.line = static_cast<int>(table.source().begin.line);
  group.name = read_group_name(reader);
  reader.require("count", "expected the number of disks of the group");
  group.count = reader.count("count").value();
  group.positions = read_positions(reader);
  group.velocities = read_velocities(reader, Serves::a_group);
  group.drift = read_drift(reader);
  group.spins = read_spins(reader);
  group.radius = read_size(reader, "radius", "from_mass", Serves::a_group);
  group.fixed = reader.flag_or_initial("fixed");
  if (group.fixed) {
    read_fixed(reader, group);
  } else {
    group.mass = read_size(reader, "mass", "from_radius", Serves::a_group);
  }
  return group;
}

GrowthPlan read_growth(const SceneOrigin& origin) {
  GrowthPlan growth;
  const toml::table* table = section(origin, "growth");
  if (table == nullptr) return growth;
  const TableReader reader(origin, "growth", *table);
  growth.given = true;
  growth.slowness = reader.number_or_initial("slowness");
  if (growth.slowness < 1e-3 || growth.slowness > 1e4) {
    reader.fail("slowness", fmt::format("is {}", growth.slowness), "expected a number from 0.001 to 10000");
  }
  growth.steps = reader.count_or_initial("steps");
  return growth;
}

Source read_source(const SceneOrigin& origin, const std::string& path, const toml::table& table) {
  const TableReader reader(origin, path, table);
  Source source;
  source.line = static_cast<int>(table.source().begin.line);
  const toml::node* region = reader.find("region");
  const std::optional<std::size_t> side = reader.choice("side");
  constexpr std::string_view expected = "expected either side = \"left\" or region = [x0, y0, x1, y1]";
  if (side && region != nullptr) reader.fail("region", "cannot be used with side", expected);
  if (!side && region == nullptr) reader.fail("side", "missing", expected);
  if (side) source.side = static_cast<Side>(*side);
  if (region != nullptr) {
    const std::vector<double> corners = as_numbers(origin, reader.key("region"), *region);
    if (corners.size() != 4) reader.fail("region", "has " + counted(corners.size(), "number"), expected);
    source.region_low = {corners[0], corners[1]};
    source.region_high = {corners[2], corners[3]};
  }
  reader.require("rate", "expected the number of disks per unit time");
  source.rate = reader.number("rate").value();
  source.radius = read_size(reader, "radius", "from_mass", Serves::any_number);
  source.mass = read_size(reader, "mass", "from_radius", Serves::any_number);
  source.velocities = read_velocities(reader, Serves::any_number);
  source.spins = read_spins(reader);
  source.limit = reader.count("limit");
  return source;
}

// The tables of an array of tables such as [[disks]], read one by one.
template <class Read>
auto read_tables(const SceneOrigin& origin, std::string_view name, Read read) {
  std::vector<decltype(read(origin, std::string{}, toml::table{}))> all;
  const toml::node* node = origin.root->get(name);
  if (node == nullptr) return all;
  const std::string expected = fmt::format("expected a table [[{}]], in double brackets", name);
  const toml::array& list = as_list(origin, std::string(name), *node, expected);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string path = fmt::format("{}.{}", name, k);
    const toml::table* table = list[k].as_table();
    if (table == nullptr) origin.fail(path, fmt::format("is {}", type_name(list[k])), expected);
    all.push_back(read(origin, path, *table));
  }
  return all;
}

double read_accuracy(const TableReader& reader, bool automatic) {
  constexpr std::string_view expected = "expected the relative error that method \"auto\" may make, as in 1e-3";
  const double accuracy = reader.number("accuracy").value_or(0.0);
  if (automatic && accuracy == 0.0) reader.fail("accuracy", "missing", expected);
  if (accuracy > most_accuracy) {
    reader.fail("accuracy", fmt::format("is {}", accuracy), fmt::format("expected at most {}", most_accuracy));
  }
  return accuracy;
}

// method = "auto": chooses method and step, once the whole scene is known.
void choose_run(Scene& scene, const PlaceOfKey& place) {
  const MethodChoice choice = choose_method(scene, scene.run.accuracy);
  if (choice.best < 0) {
    fail_input(place("run.accuracy"), fmt::format("is {}: {}", scene.run.accuracy, choice.why),
               "expected a larger error, or a method other than \"auto\"");
  }
  const MethodOffer& best = choice.offers[static_cast<std::size_t>(choice.best)];
  scene.run.method = best.method;
  scene.run.dt = best.dt;
  scene.run.choice = choice.why;
}

RunPlan read_run(const SceneOrigin& origin) {
  const TableReader reader(origin, "run", required_section(origin, "run", "t_end"));
  RunPlan run;
  const std::size_t word = reader.choice_or_initial("method");
  run.automatic = word == method_names.size();
  run.method = run.automatic ? Method::exact : static_cast<Method>(word);
  run.accuracy = read_accuracy(reader, run.automatic);
  run.dt = reader.number("dt").value_or(0.0);
  reader.require("t_end", "expected the time at which the run ends");
  run.t_end = reader.number("t_end").value();
  return run;
}

std::vector<std::string> read_plots(const TableReader& output) {
  std::vector<std::string> plots;
  const toml::node* node = output.find("plots");
  if (node == nullptr) return plots;
  const std::string key = output.key("plots");
  const toml::array& list = as_list(output.origin(), key, *node, "expected a list of plot names");
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string entry = fmt::format("{}.{}", key, k);
    const std::string name = as_text(output.origin(), entry, list[k]);
    if (std::find(plot_names.begin(), plot_names.end(), name) == plot_names.end()) {
      output.origin().fail(entry, fmt::format("unknown plot {}", in_quotes(name)), expected_one_of(plot_names, name));
    }
    if (std::find(plots.begin(), plots.end(), name) == plots.end()) plots.push_back(name);
  }
  return plots;
}

// Seconds of wall time; a number, or text with a unit.
double read_checkpoint_interval(const TableReader& output) {
  const toml::node* node = output.find("checkpoint");
  if (node == nullptr) return 0.0;
  if (!node->is_string()) return output.number("checkpoint").value();
  const std::string text = output.text("checkpoint").value();
  const std::optional<double> seconds = parse_duration(text);
  if (!seconds) output.fail("checkpoint", fmt::format("is {}", in_quotes(text)), expected_duration);
  return *seconds;
}

OutputPlan read_output(const SceneOrigin& origin, const Scene& scene) {
  OutputPlan output;
  const toml::table* table = section(origin, "output");
  if (table == nullptr) return output;
  const TableReader reader(origin, "output", *table);
  output.trajectory = static_cast<TrajectoryFormat>(reader.choice_or_initial("trajectory"));
  output.select = read_selection(reader, scene);
  output.single_precision = read_single_precision(reader);
  output.dimensions = read_third_dimension(reader) ? 3 : 2;
  output.series = reader.flag_or_initial("series");
  output.plots = read_plots(reader);
  read_movie(reader, output);
  output.view = read_view(reader);
  output.checkpoint = read_checkpoint_interval(reader);
  output.every = reader.number("every").value_or(wants_frames(output) ? scene.run.t_end / 100.0 : 0.0);
  return output;
}

// Sets width and height of the box; with packing_fraction, from the radii drawn.
void settle_box(Scene& scene, const BoxSize& size, const PlaceOfKey& place) {
  if (!size.packing_fraction) {
    scene.box.width = *size.width;
    scene.box.height = *size.height;
    return;
  }
  double radius_squared = 0.0;
  DiskId first_id = 0;
  for (const DiskGroup& group : scene.groups) {
    radius_squared += summarise_sizes(group, scene.seed, first_id).radius_squared;
    first_id += static_cast<DiskId>(group.count);
  }
  const double area = std::numbers::pi * radius_squared / *size.packing_fraction;
  const double aspect = size.aspect.value_or(1.0);
  scene.box.height = std::sqrt(area / aspect);
  scene.box.width = aspect * scene.box.height;
  if (area > 0.0) return;  // check_box checks the range
  fail_input(place("box.packing_fraction"), fmt::format("gives a box of {} x {}", scene.box.width, scene.box.height),
             "expected disks that fill a part of the box, or width and height");
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::string& folder,
                  const std::vector<Override>& overrides, const FrameReader& frames) {
  const FloatEnvironment environment;
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    fail_input(fmt::format("{}:1", name), "the file is empty", "expected a scene with [box], [[disks]] and [run]");
  }
  toml::table tree = parse_scene_tree(text, name);
  for (const Override& change : overrides) apply_override(tree, change);
  const SceneOrigin origin{name, folder, &tree, overrides, frames};
  const PlaceOfKey place = [&origin](std::string_view key) { return origin.where(key); };
  const TableReader root(origin, "", tree);
  Scene scene;
  scene.file = name;
  scene.title = read_title(root);
  scene.seed = read_seed(root);
  const BoxSize size = read_box(origin, scene);
  scene.physics = read_physics(origin);
  scene.groups = read_tables(origin, "disks", read_group);
  scene.sources = read_tables(origin, "sources", read_source);
  if (scene.groups.empty() && scene.sources.empty()) {
    origin.fail("disks", "missing", "expected one table [[disks]] or more");
  }
  read_restitutions(origin, scene);
  scene.physics.surfaces = read_surfaces(origin);
  scene.walls = read_tables(origin, "walls", read_wall);
  for (const InnerWall& wall : scene.walls) scene.box.inner_walls_move |= wall.motion.moves();
  scene.growth = read_growth(origin);
  scene.run = read_run(origin);
  scene.output = read_output(origin, scene);
  const toml::table* analysis = section(origin, "analysis");
  if (analysis != nullptr) scene.analysis = read_analysis(origin, *analysis, scene);
  check_parts(scene, place);
  settle_box(scene, size, place);
  const double largest_radius = check_box(scene, place);
  settle_sides(scene, largest_radius, place);
  check_sweeps(scene, place);
  settle_analysis(scene, place);
  if (scene.run.automatic) {
    choose_run(scene, place);
    check_times(scene, place);  // of the step chosen
  }
  return scene;
}

Scene load_scene(const std::string& path, const std::vector<Override>& overrides, const FrameReader& frames) {
  const std::string text = read_text_file(path, path);
  return parse_scene(text, path, std::filesystem::path(path).parent_path().string(), overrides, frames);
}

}  // namespace carom
