#include "core/scene/scene_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/input_message.hpp"
#include "core/disks/place_slack.hpp"
#include "core/scene/scene_motion.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_shear.hpp"

namespace carom {

namespace {

constexpr std::string_view table_kind = "box.side";
constexpr std::string_view motion_kind = "box.side.motion";

bool is_vertical(std::size_t s) {
  return s < 2;
}

// The length of the box perpendicular to this side.
double length_across(const Domain& box, std::size_t s) {
  return is_vertical(s) ? box.width : box.height;
}

// Throws InputError for a key that only walls may have, if this side is none.
void require_wall(const TableReader& side, std::string_view name, SideKind kind) {
  if (side.find(name) == nullptr || kind == SideKind::wall) return;
  const auto kind_name = side_kind_names[static_cast<std::size_t>(kind)];
  side.fail(name, fmt::format("cannot be used for a side of kind \"{}\"", kind_name), "expected kind = \"wall\"");
}

// The component into the box of a velocity or an amplitude.
double read_inward(const TableReader& motion, const MotionKeys& keys, std::size_t s) {
  const double across = is_vertical(s) ? keys.value.x : keys.value.y;
  const double along = is_vertical(s) ? keys.value.y : keys.value.x;
  if (along != 0.0) {
    motion.fail(keys.name, fmt::format("is {} along the side, but a side moves only across itself", along),
                "expected 0; to drag disks along use an inner wall ([[walls]]) and wall_roughness");
  }
  if (!in_range(keys.dimension(), std::abs(across))) {
    motion.fail(keys.name, fmt::format("is {}", across), expected_range(keys.dimension()));
  }
  return s % 2 == 0 ? across : -across;
}

SideMotion read_motion(const TableReader& side, std::size_t s) {
  const TableReader table = motion_table(side, motion_kind);
  const MotionKeys keys = read_motion_keys(side, table);
  SideMotion motion;
  motion.kind = keys.kind;
  motion.period = keys.period;
  (motion.vibrates() ? motion.amplitude : motion.speed) = read_inward(table, keys, s);
  return motion;
}

void read_side(const TableReader& side, std::size_t s, Scene& scene) {
  Domain& domain = scene.box;
  domain.sides[s] = static_cast<SideKind>(side.choice_or_initial("kind"));
  for (const char* key : {"restitution", "temperature", "motion", "place"}) require_wall(side, key, domain.sides[s]);
  if (const auto temperature = side.number("temperature")) {
    if (side.find("restitution") != nullptr) {
      side.fail("restitution", "cannot be used with temperature, which draws the velocity anew",
                "expected one of the two");
    }
    if (side.find("motion") != nullptr) {
      side.fail("motion", "cannot be used with temperature: thermal sides do not move", "expected one of the two");
    }
    domain.temperatures[s] = *temperature;
    domain.restitutions[s] = 1.0;
  }
  if (const auto restitution = side.number("restitution")) domain.restitutions[s] = *restitution;
  scene.side_places[s] = side.number("place");
  if (side.find("motion") != nullptr) {
    domain.motions[s] = read_motion(side, s);
  } else if (scene.side_places[s]) {
    side.fail("place", "cannot be used for a side that does not move", "expected motion as well");
  }
}

std::string key_of(std::size_t s, std::string_view key) {
  return fmt::format("box.{}.{}", side_names[s], key);
}

// The inset of a side at time 0, or in the middle of its vibration.
double first_inset(const Scene& scene, std::size_t s) {
  const SideMotion& motion = scene.box.motions[s];
  if (scene.side_places[s]) {
    return s % 2 == 0 ? *scene.side_places[s] : length_across(scene.box, s) - *scene.side_places[s];
  }
  return motion.vibrates() ? std::abs(motion.amplitude) : 0.0;
}

void settle_side(Scene& scene, std::size_t s, const PlaceOfKey& place) {
  SideMotion& motion = scene.box.motions[s];
  motion.inset = first_inset(scene, s);
  const double length = length_across(scene.box, s);
  const double t_end = scene.run.t_end;
  motion.furthest = motion.largest_inset(t_end);
  // A side that reaches the edge in decimals may be beyond it by rounding.
  const double slack = place_slack(scene.box, 0.0);
  if (motion.least_inset(t_end) >= -slack && motion.furthest <= length + slack) return;
  const std::string key = key_of(s, scene.side_places[s] ? "place" : "motion");
  fail_input(place(key), fmt::format("brings the {} side out of the box before run.t_end = {}", side_names[s], t_end),
             fmt::format("expected a side that stays between 0 and {}", length));
}

// A lower bound on the distance of two opposite sides until t_end.
double least_distance(const Domain& box, std::size_t s, double t_end) {
  const SideMotion& a = box.motions[s];
  const SideMotion& b = box.motions[s + 1];
  const double length = length_across(box, s);
  if (!a.vibrates() && !b.vibrates()) {  // straight lines: at one of the ends
    return length - std::max(a.inset + b.inset, (a.inset + a.speed * t_end) + (b.inset + b.speed * t_end));
  }
  const bool together = a.kind == b.kind && a.period == b.period;
  if (together) return length - (a.inset + b.inset) - std::abs(a.amplitude + b.amplitude);
  return length - a.furthest - b.furthest;
}

}  // namespace

void read_sides(const TableReader& box, Scene& scene) {
  Domain& domain = scene.box;
  domain.restitutions.fill(box.number_or_initial("wall_restitution"));
  domain.shear.rate = read_shear_rate(box);
  for (std::size_t s = 0; s < side_names.size(); ++s) {
    const std::string_view name = side_names[s];
    const toml::node* node = box.find(name);
    if (node != nullptr && node->is_table()) {
      read_side(TableReader(box.origin(), box.key(name), *node->as_table(), table_kind), s, scene);
    } else if (node != nullptr && !node->is_string()) {
      box.fail(name, fmt::format("is {}", type_name(*node)), "expected a string, or a table { kind = ... }");
    } else {
      domain.sides[s] = static_cast<SideKind>(box.choice_or_initial(name));
    }
  }
}

void settle_sides(Scene& scene, double largest_radius, const PlaceOfKey& place) {
  settle_shear(scene, largest_radius, place);
  if (!scene.box.has_moving_side()) return;
  for (std::size_t s = 0; s < side_names.size(); ++s) {
    if (scene.box.motions[s].moves()) settle_side(scene, s, place);
  }
  for (const std::size_t s : {0U, 2U}) {
    const std::size_t moving = scene.box.motions[s].moves() ? s : s + 1;
    if (!scene.box.motions[moving].moves()) continue;
    const double least = least_distance(scene.box, s, scene.run.t_end);
    if (least >= 2.0 * largest_radius - place_slack(scene.box, largest_radius)) continue;
    fail_input(place(key_of(moving, "motion")),
               fmt::format("brings the {} and {} sides within {:.6g} of each other before run.t_end = {}",
                           side_names[s], side_names[s + 1], std::max(least, 0.0), scene.run.t_end),
               fmt::format("expected at least {}, the diameter of the largest disk", 2.0 * largest_radius));
  }
  scene.box.move_walls(0.0);
}

}  // namespace carom
