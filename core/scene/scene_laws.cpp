#include "core/scene/scene_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"
#include "core/base/random.hpp"
#include "core/base/short_number.hpp"
#include "core/disks/shear.hpp"
#include "core/scene/csv.hpp"

namespace carom {

namespace {

constexpr std::string_view positions_expected =
    "expected \"random\", \"growth\", \"square\", \"hexagonal\", a list of [x, y], { file = \"p.csv\" }, or "
    "{ frame = \"DIR\" }";
constexpr std::string_view velocities_expected =
    "expected { maxwell = T }, { uniform = v }, a list of [vx, vy], { file = \"v.csv\" }, or { frame = \"DIR\" }";
constexpr std::string_view source_velocities_expected = "expected { maxwell = T } or { uniform = v }";

// The text of what a radius or mass may be. other_key: as in read_size.
std::string size_expected(std::string_view other_key, Serves serves) {
  const bool any_number = serves == Serves::any_number;
  return fmt::format(
      "expected a number, {}{{ uniform = [low, high] }}, {{ normal = [mean, deviation] }}, "
      "{{ lognormal = [median, sigma] }}, {{ choice = [a, b] }}, {}{{ {} = density }}{}",
      any_number ? "" : "a list of numbers, ", any_number ? "or " : "", other_key,
      any_number ? "" : ", or { frame = \"DIR\" }");
}

// The one key of an inline table such as { maxwell = 1.0 }; throws unless there is exactly one.
std::string_view only_key(const TableReader& owner, std::string_view name, const toml::table& table,
                          std::string_view expected) {
  if (table.size() != 1) owner.fail(name, fmt::format("has {} keys", table.size()), expected);
  return table.begin()->first.str();
}

// The rows of the CSV file named by the key "file" of law; file is set to that name.
std::vector<Vec2> read_csv_law(const TableReader& law, CsvPairs pairs, std::string& file) {
  const SceneOrigin& origin = law.origin();
  const std::string key = law.key("file");
  file = law.text("file").value();
  if (file.empty() || file.find('\0') != std::string::npos)
    law.fail("file", "is not a file name", "expected a CSV file");
  const std::filesystem::path path = std::filesystem::path(origin.folder) / file;
  const std::string text = read_text_file(path.string(), fmt::format("{} {}", origin.where(key), in_quotes(file)));
  return parse_csv_pairs(text, file, key, pairs);
}

// The factor of the radii of a frame; useful since disks of time stepping overlap a little.
double scale_of_radii(const TableReader& law, std::string_view name) {
  const std::optional<double> scale = law.number("scale");
  if (scale && name != "radius") {
    law.fail("scale", fmt::format("cannot be used for {}", name), "expected it only for radius");
  }
  return scale.value_or(1.0);
}

// { frame = "DIR or trajectory" }, with index = n (from 1) or time = t, or else the last frame. file is set to its name
// in messages. Relative paths start in the folder of the scene, as for CSV files.
SceneFrame read_frame(const TableReader& owner, std::string_view name, const toml::table& table, std::string& file) {
  const TableReader law(owner.origin(), owner.key(name), table, "frame");
  constexpr std::string_view expected = "expected { frame = \"DIR\" }, with index = n (from 1) or time = t";
  FrameAsked asked;
  law.require("frame", expected);
  file = law.text("frame").value();
  if (file.empty() || file.find('\0') != std::string::npos) law.fail("frame", "is not a file name", expected);
  asked.path = (std::filesystem::path(law.origin().folder) / file).string();
  asked.index = law.count("index");
  asked.time = law.number("time");
  asked.velocities = name == "velocities";
  if (asked.index && asked.time) law.fail("time", "cannot be used with index", expected);
  if (const auto group = law.text("group")) {
    asked.group = *group;
    if (asked.group.empty()) law.fail("group", "is empty", "expected the name of a group of that run");
  }
  if (!law.origin().frames) law.fail("frame", "cannot be read here", "expected positions of another kind");
  const double scale = scale_of_radii(law, name);
  try {
    SceneFrame frame = law.origin().frames(asked);
    for (double& radius : frame.radius) radius *= scale;
    return frame;
  } catch (const InputError& error) {
    fail_input(law.origin().where(law.key("frame")), error.what());
  }
}

// Throws InputError for a list of values (in the scene, or from `file`) that is not for a group: only groups have a
// known number of disks.
void check_serves(const TableReader& owner, std::string_view name, Serves serves, const std::string& file) {
  if (serves == Serves::a_group) return;
  owner.fail(name, file.empty() ? "is a list" : "is the list in " + file, "expected a law for any number of disks");
}

bool is_frame(const toml::table& table) {
  return table.get("frame") != nullptr;
}

bool has_shear(const SceneOrigin& origin) {
  const toml::table* box = origin.root->get_as<toml::table>("box");
  return box != nullptr && (*box)["shear_rate"].value_or(0.0) != 0.0;
}

bool draws_velocities(const SceneOrigin& origin) {
  const toml::table* physics = origin.root->get_as<toml::table>("physics");
  return physics != nullptr && (*physics)["diffusion"].value_or(0.0) > 0.0 && !(*physics)["accumulate"].value_or(false);
}

// The velocities of a frame for [[disks]], without the shear flow of the run that wrote them.
std::vector<Vec2> velocities_of(const TableReader& owner, SceneFrame frame, const std::string& file) {
  if (frame.brownian && !draws_velocities(owner.origin())) {
    owner.fail("velocities", fmt::format("are from {}, whose Brownian disks have no velocities", file),
               "expected velocities of another kind");
  }
  if (!has_shear(owner.origin())) return std::move(frame.velocities);
  if (!frame.shear_rate) {
    owner.fail("velocities", fmt::format("are from {}, which does not tell whether they include a shear flow", file),
               "expected the folder of a run, with its scene.toml");
  }
  const Shear shear{*frame.shear_rate};
  for (std::size_t i = 0; i < frame.velocities.size(); ++i) {
    frame.velocities[i].x -= shear.flow(frame.positions[i].y, frame.height);
  }
  return std::move(frame.velocities);
}

SizeLaw read_uniform_size(const TableReader& law, const toml::node& node) {
  SizeLaw size;
  size.kind = SizeLaw::Kind::uniform;
  const std::vector<double> range = as_numbers(law.origin(), law.key("uniform"), node);
  constexpr std::string_view expected = "expected [low, high] with 0 < low <= high";
  if (range.size() != 2) law.fail("uniform", "has " + counted(range.size(), "number"), expected);
  if (!(range[0] > 0.0 && range[0] <= range[1])) {
    law.fail("uniform", fmt::format("is [{}, {}]", range[0], range[1]), expected);
  }
  size.low = range[0];
  size.high = range[1];
  return size;
}

// Two numbers under a key of a law; the first is above 0.
std::vector<double> read_two(const TableReader& law, std::string_view name, std::string_view expected) {
  std::vector<double> numbers = as_numbers(law.origin(), law.key(name), *law.find(name));
  if (numbers.size() != 2) law.fail(name, "has " + counted(numbers.size(), "number"), expected);
  return numbers;
}

SizeLaw read_normal_size(const TableReader& law) {
  constexpr std::string_view expected =
      "expected [mean, deviation] with 0 <= deviation and 4 deviations below the mean (lognormal sizes have no such "
      "bound)";
  const std::vector<double> two = read_two(law, "normal", expected);
  if (!(two[1] >= 0.0 && two[0] > most_deviations * two[1])) {
    law.fail("normal", fmt::format("is [{}, {}]", two[0], two[1]), expected);
  }
  SizeLaw size;
  size.kind = SizeLaw::Kind::normal;
  size.value = two[0];
  size.deviation = two[1];
  return size;
}

SizeLaw read_lognormal_size(const TableReader& law) {
  constexpr std::string_view expected = "expected [median, sigma] with 0 < median and 0 <= sigma <= 2";
  const std::vector<double> two = read_two(law, "lognormal", expected);
  if (!(two[0] > 0.0 && two[1] >= 0.0 && two[1] <= 2.0)) {
    law.fail("lognormal", fmt::format("is [{}, {}]", two[0], two[1]), expected);
  }
  SizeLaw size;
  size.kind = SizeLaw::Kind::lognormal;
  size.value = two[0];
  size.deviation = two[1];
  return size;
}

// Throws InputError unless the list has numbers and fine() holds for each of them.
template <class Fine>
void check_each(const TableReader& law, std::string_view name, const std::vector<double>& numbers,
                std::string_view expected, Fine fine) {
  if (numbers.empty()) law.fail(name, "is empty", expected);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (fine(numbers[k])) continue;
    law.origin().fail(fmt::format("{}.{}", law.key(name), k), fmt::format("is {}", numbers[k]), expected);
  }
}

// other_key: as in read_size.
SizeLaw read_choice_of_sizes(const TableReader& law, std::string_view other_key) {
  constexpr std::string_view expected =
      "expected { choice = [a, b], weights = [1, 2] } with numbers above 0; weights may be left out";
  SizeLaw size;
  size.kind = SizeLaw::Kind::choice;
  for (const std::string_view other :
       {std::string_view("uniform"), std::string_view("normal"), std::string_view("lognormal"), other_key}) {
    if (law.find(other) != nullptr && law.find("choice") != nullptr) {
      law.fail(other, "cannot be used with choice", "expected one of the two, and weights only with choice");
    }
  }
  const toml::node* weights = law.find("weights");
  if (weights != nullptr) size.weights = as_numbers(law.origin(), law.key("weights"), *weights);
  size.values = as_numbers(law.origin(), law.key("choice"), law.require("choice", expected));
  check_each(law, "choice", size.values, expected, [](double v) { return v > 0.0; });
  if (weights == nullptr) size.weights.assign(size.values.size(), 1.0);
  check_each(law, "weights", size.weights, "expected numbers from 1e-9 to 1e9, or 0",
             [](double w) { return w == 0.0 || (w >= 1e-9 && w <= 1e9); });
  if (size.weights.size() != size.values.size()) {
    law.fail("weights",
             fmt::format("has {} for {} values of choice", counted(size.weights.size(), "number"), size.values.size()),
             "expected one for each");
  }
  if (std::all_of(size.weights.begin(), size.weights.end(), [](double w) { return w == 0.0; })) {
    law.fail("weights", "are all 0", "expected at least one above 0");
  }
  return size;
}

SizeLaw read_size_list(const TableReader& owner, const std::string& key, Dimension dimension, const toml::node& node) {
  SizeLaw size;
  size.kind = SizeLaw::Kind::list;
  size.values = as_numbers(owner.origin(), key, node);
  for (std::size_t i = 0; i < size.values.size(); ++i) {
    const double value = size.values[i];
    if (value > 0.0 && in_range(dimension, value)) continue;
    owner.origin().fail(fmt::format("{}.{}", key, i), fmt::format("is {}", value),
                        value > 0.0 ? expected_range(dimension) : "expected a number above 0");
  }
  return size;
}

// [x0, y0, x1, y1] or { circle = [x, y, r] }; absent without the key.
std::optional<StartRegion> read_start_region(const TableReader& group) {
  const toml::node* node = group.find("region");
  if (node == nullptr) return {};
  constexpr std::string_view expected = "expected [x0, y0, x1, y1], or { circle = [x, y, r] }";
  const std::string key = group.key("region");
  StartRegion region;
  if (const toml::table* table = node->as_table()) {
    const TableReader reader(group.origin(), key, *table, "disks.region");
    const toml::node& circle = reader.require("circle", expected);
    const std::vector<double> c = as_numbers(group.origin(), reader.key("circle"), circle);
    if (c.size() != 3) reader.fail("circle", "has " + counted(c.size(), "number"), "expected [x, y, r]");
    if (!(c[2] > 0.0)) reader.fail("circle", fmt::format("has radius {}", c[2]), "expected [x, y, r] with r above 0");
    region.circle = true;
    region.centre = {c[0], c[1]};
    region.radius = c[2];
    region.low = {c[0] - c[2], c[1] - c[2]};
    region.high = {c[0] + c[2], c[1] + c[2]};
    return region;
  }
  if (!node->is_array()) group.fail("region", fmt::format("is {}", type_name(*node)), expected);
  const std::vector<double> corners = as_numbers(group.origin(), key, *node);
  if (corners.size() != 4) group.fail("region", "has " + counted(corners.size(), "number"), expected);
  region.low = {corners[0], corners[1]};
  region.high = {corners[2], corners[3]};
  return region;
}

}  // namespace

PositionLaw read_positions(const TableReader& group) {
  const toml::node& node = group.require("positions", positions_expected);
  const std::string key = group.key("positions");
  PositionLaw law;
  law.where = group.origin().where(key);
  if (node.is_string()) {
    law.kind = static_cast<PositionLaw::Kind>(group.choice("positions").value());
  } else if (const toml::table* table = node.as_table(); table != nullptr && is_frame(*table)) {
    law.kind = PositionLaw::Kind::list;
    law.list = read_frame(group, "positions", *table, law.file).positions;
  } else if (table != nullptr) {
    const TableReader reader(group.origin(), key, *table, "disks.positions");
    only_key(group, "positions", *table, positions_expected);
    law.kind = PositionLaw::Kind::list;
    law.list = read_csv_law(reader, CsvPairs::places, law.file);
  } else {
    as_list(group.origin(), key, node, positions_expected);
    law.kind = PositionLaw::Kind::list;
    law.list = as_pairs(group.origin(), key, node);
  }
  law.region = read_start_region(group);
  return law;
}

std::vector<double> read_spins_of_frame(const TableReader& owner, const toml::table& table, std::string& file) {
  SceneFrame frame = read_frame(owner, "spin", table, file);
  frame.spin.resize(frame.positions.size(), 0.0);
  return std::move(frame.spin);
}

Vec2 read_drift(const TableReader& group) {
  const toml::node* node = group.find("drift");
  if (node == nullptr) return {};
  constexpr std::string_view expected = "expected [vx, vy]";
  if (!node->is_array()) group.fail("drift", fmt::format("is {}", type_name(*node)), expected);
  const std::vector<double> v = as_numbers(group.origin(), group.key("drift"), *node);
  if (v.size() != 2) group.fail("drift", "has " + counted(v.size(), "number"), expected);
  return {v[0], v[1]};
}

VelocityLaw read_velocities(const TableReader& owner, Serves serves) {
  const std::string_view expected = serves == Serves::any_number ? source_velocities_expected : velocities_expected;
  VelocityLaw law;
  const toml::node* node = owner.find("velocities");
  if (node == nullptr) return law;
  const std::string key = owner.key("velocities");
  const toml::table* table = node->as_table();
  if (table == nullptr) {
    as_list(owner.origin(), key, *node, expected);
    law.kind = VelocityLaw::Kind::list;
    check_serves(owner, "velocities", serves, {});
    law.list = as_pairs(owner.origin(), key, *node);
    return law;
  }
  if (is_frame(*table)) {
    law.kind = VelocityLaw::Kind::list;
    SceneFrame frame = read_frame(owner, "velocities", *table, law.file);
    check_serves(owner, "velocities", serves, law.file);
    law.list = velocities_of(owner, std::move(frame), law.file);
    return law;
  }
  const TableReader reader(owner.origin(), key, *table, "disks.velocities");
  const std::string_view kind = only_key(owner, "velocities", *table, expected);
  if (kind == "maxwell") {
    law.kind = VelocityLaw::Kind::maxwell;
    law.temperature = reader.number("maxwell").value();
  } else if (kind == "uniform") {
    law.kind = VelocityLaw::Kind::uniform;
    law.limit = reader.number("uniform").value();
  } else {
    law.kind = VelocityLaw::Kind::list;
    law.list = read_csv_law(reader, CsvPairs::any, law.file);
    check_serves(owner, "velocities", serves, law.file);
  }
  return law;
}

SizeLaw read_size(const TableReader& owner, std::string_view name, std::string_view other_key, Serves serves) {
  const std::string expected = size_expected(other_key, serves);
  const toml::node& node = owner.require(name, expected);
  const std::string key = owner.key(name);
  if (node.is_array()) {
    check_serves(owner, name, serves, {});
    return read_size_list(owner, key, name == "radius" ? Dimension::length : Dimension::mass, node);
  }
  SizeLaw law;
  if (const toml::table* table = node.as_table()) {
    if (is_frame(*table)) {
      const SceneFrame frame = read_frame(owner, name, *table, law.file);
      check_serves(owner, name, serves, law.file);
      law.kind = SizeLaw::Kind::list;
      law.values = name == "radius" ? frame.radius : frame.mass;
      return law;
    }
    const TableReader reader(owner.origin(), key, *table, fmt::format("disks.{}", name));
    if (reader.find("choice") != nullptr || reader.find("weights") != nullptr) {
      return read_choice_of_sizes(reader, other_key);
    }
    const std::string_view kind = only_key(owner, name, *table, expected);
    if (kind == "uniform") return read_uniform_size(reader, *table->get("uniform"));
    if (kind == "normal") return read_normal_size(reader);
    if (kind == "lognormal") return read_lognormal_size(reader);
    law.kind = SizeLaw::Kind::from_other;
    law.density = reader.number(other_key).value();
    return law;
  }
  if (!node.is_number()) owner.fail(name, fmt::format("is {}", type_name(node)), expected);
  if (const auto mass = node.value<double>(); name == "mass" && mass && *mass == HUGE_VAL) {
    owner.fail(name, "is inf",
               "expected a number above 0; for disks that never move use fixed = true instead of a mass");
  }
  law.value = owner.number(name).value();
  return law;
}

}  // namespace carom
