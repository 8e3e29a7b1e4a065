#include "core/scene/scene_walls.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/short_number.hpp"
#include "core/scene/scene_motion.hpp"

namespace carom {

namespace {

constexpr std::string_view expected_points =
    "expected from = [x, y] and to = [x, y], or points = [[x, y], [x, y], ...]";

Vec2 read_point(const TableReader& reader, std::string_view name) {
  const toml::node& node = reader.require(name, expected_points);
  const std::vector<double> numbers = as_numbers(reader.origin(), reader.key(name), node);
  if (numbers.size() != 2) reader.fail(name, "has " + counted(numbers.size(), "number"), "expected [x, y]");
  return {numbers[0], numbers[1]};
}

std::vector<Vec2> read_points(const TableReader& reader) {
  const toml::node* node = reader.find("points");
  if (node == nullptr) return {read_point(reader, "from"), read_point(reader, "to")};
  for (const std::string_view other : {"from", "to"}) {
    if (reader.find(other) != nullptr) reader.fail(other, "cannot be used with points", expected_points);
  }
  const std::string key = reader.key("points");
  as_list(reader.origin(), key, *node, expected_points);
  std::vector<Vec2> points = as_pairs(reader.origin(), key, *node);
  if (points.size() < 2)
    reader.fail("points", fmt::format("is a list of {}", points.size()), "expected two points or more");
  return points;
}

// A segment shorter than the least length has no direction: the square of its length underflows.
void check_lengths(const TableReader& reader, const std::vector<Vec2>& points) {
  const std::string_view key = reader.find("points") != nullptr ? "points" : "to";
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Vec2 p = points[k];
    const Vec2 before = points[k - 1];
    if (p == before) {
      reader.fail(key, fmt::format("has the point [{}, {}] twice in a row", p.x, p.y),
                  "expected segments with a length");
    }
    const double length = std::hypot(p.x - before.x, p.y - before.y);
    if (in_range(Dimension::length, length)) continue;
    reader.fail(key, fmt::format("has a segment of length {} to [{}, {}]", length, p.x, p.y),
                expected_range(Dimension::length));
  }
}

WallMotion read_motion(const TableReader& wall) {
  const TableReader table = motion_table(wall, "walls.motion");
  const MotionKeys keys = read_motion_keys(wall, table);
  if (keys.value == Vec2{}) table.fail(keys.name, "is [0, 0]", "expected a wall that moves, or no motion");
  for (const double part : {keys.value.x, keys.value.y}) {
    if (part == 0.0 || in_range(keys.dimension(), std::abs(part))) continue;
    table.fail(keys.name, fmt::format("is [{}, {}]", keys.value.x, keys.value.y), expected_range(keys.dimension()));
  }
  WallMotion motion;
  motion.along = keys.value;
  motion.pace.kind = keys.kind;
  motion.pace.period = keys.period;
  (motion.pace.vibrates() ? motion.pace.amplitude : motion.pace.speed) = 1.0;
  return motion;
}

}  // namespace

InnerWall read_wall(const SceneOrigin& origin, const std::string& path, const toml::table& table) {
  const TableReader reader(origin, path, table);
  InnerWall wall;
  wall.line = static_cast<int>(table.source().begin.line);
  wall.points = read_points(reader);
  check_lengths(reader, wall.points);
  wall.sink = reader.choice_or_initial("kind") == 1;
  const double common = (*origin.root)["box"]["wall_restitution"].value_or(1.0);
  const std::optional<double> own = reader.number("restitution");
  if (own && wall.sink) reader.fail("restitution", "cannot be used with kind = \"sink\"", "expected a wall");
  wall.restitution = wall.sink ? 1.0 : own.value_or(common);
  if (reader.find("motion") != nullptr) wall.motion = read_motion(reader);
  return wall;
}

}  // namespace carom
