#include "app/run/scene_in_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/scene_names.hpp"
#include "core/step/thermostat.hpp"

namespace carom {

namespace {

// " at speeds up to 2, accelerations up to 8, 0.8 times gravity's": if that factor is below 1, disks on a wall that
// moves up and down stay on it.
std::string motion_text(double speed, double acceleration, double gravity) {
  std::string text = fmt::format(" at speeds up to {:.3g}", speed);
  if (acceleration == 0.0) return text;
  text += fmt::format(", accelerations up to {:.3g}", acceleration);
  return gravity > 0.0 ? text + fmt::format(", {:.3g} times gravity's", acceleration / gravity) : text;
}

// The restitution at walls: one for all, or each with the name of its side.
std::string walls_text(const Domain& box) {
  std::string text;
  bool equal = true;
  std::optional<double> first;
  for (const Side side : all_sides) {
    if (box.side(side) != SideKind::wall) continue;
    const std::string_view name = side_names[static_cast<std::size_t>(side)];
    if (box.is_thermal(side)) {
      equal = false;
      text += fmt::format(", the {} wall at temperature {:g}", name, box.temperature(side));
      continue;
    }
    equal = equal && box.restitution(side) == first.value_or(box.restitution(side));
    if (!first) first = box.restitution(side);
    text += fmt::format(", {:g} at the {} wall", box.restitution(side), name);
  }
  return equal && first ? fmt::format(", {:g} at walls", *first) : text;
}

// Each side that moves, then the largest speed and acceleration of all inner walls.
std::string moving_walls_text(const Scene& scene) {
  const double gravity = scene.physics.gravity.size;
  std::string text;
  for (const Side side : all_sides) {
    const auto k = static_cast<std::size_t>(side);
    const SideMotion& motion = scene.box.motions[k];
    if (!scene.box.moves(side)) continue;
    text += fmt::format("; the {} wall moves{}", side_names[k],
                        motion_text(motion.largest_speed(), motion.largest_acceleration(), gravity));
  }
  if (!scene.box.inner_walls_move) return text;
  double acceleration = 0.0;
  for (const InnerWall& wall : scene.walls) acceleration = std::max(acceleration, wall.motion.largest_acceleration());
  return text + "; inner walls move" + motion_text(fastest_inner_wall(scene), acceleration, gravity);
}

std::string gravity_text(const Gravity& g) {
  if (!g.acts()) return "no gravity; ";
  if (!g.is_tilted() && g.down > 0.0) return fmt::format("gravity {:g} downwards; ", g.down);
  return fmt::format("gravity [{:g}, {:g}]; ", 0.0 - g.left, 0.0 - g.down);
}

std::string restitution_text(const Restitution& r) {
  if (r.viscosity == 0.0) return fmt::format("{:g}", r.least);
  return fmt::format("max({:g}, 1 - {:g} v^(1/5))", r.least, r.viscosity);
}

// "0.9 of disks, 0.5 of light with heavy".
std::string restitutions_text(const Scene& scene) {
  const Physics& p = scene.physics;
  std::string text = restitution_text({p.restitution, p.law.viscosity}) + " of disks";
  for (const GroupPair& pair : p.law.pairs) {
    text += fmt::format(", {} of {} with {}", restitution_text(pair.restitution), name_of_group(scene, pair.first),
                        name_of_group(scene, pair.second));
  }
  return text;
}

// "0.5 along surfaces, friction 0.3".
std::string roughness_text(const Roughness& r) {
  const std::string friction = r.friction < HUGE_VAL ? fmt::format(", friction {:g}", r.friction) : "";
  return fmt::format("{:g} along surfaces{}", r.restitution, friction);
}

// Empty if disks are smooth.
std::string surfaces_text(const Surfaces& surfaces) {
  if (!surfaces.are_rough()) return "";
  const std::string walls = surfaces.walls.acts() ? fmt::format(" (walls: {})", roughness_text(surfaces.walls)) : "";
  return fmt::format("; rough disks: restitution {}{}", roughness_text(surfaces.disks), walls);
}

}  // namespace

std::string physics_text(const Scene& scene) {
  const Physics& p = scene.physics;
  std::string text = gravity_text(p.gravity);
  const bool elastic = p.restitution == 1.0 && !p.law.dissipates();
  text += !elastic ? fmt::format("restitution {}", restitutions_text(scene)) : "elastic collisions";
  const std::string walls = walls_text(scene.box);
  text += elastic && walls == ", 1 at walls" ? ", at walls too" : walls;
  text += moving_walls_text(scene);
  text += surfaces_text(p.surfaces);
  if (scene.box.shear.acts()) text += fmt::format("; a shear flow of rate {:g}", scene.box.shear.rate);
  if (const auto& tc = p.collapse_contact_time) text += fmt::format("; the TC model, contact time {:g}", *tc);
  if (p.diffusion > 0.0) {
    text += fmt::format("; Brownian motion, D = {:g}{}", p.diffusion, p.accumulate ? ", accumulating velocity" : "");
  }
  if (const Thermostat& bath = p.thermostat; bath.acts()) {
    text += fmt::format("; a thermostat ({}) at temperature {:g}, rate {:g}, kicks every {:g}",
                        thermostat_names[static_cast<std::size_t>(bath.kind)], bath.temperature, bath.rate,
                        kick_interval(scene));
  }
  for (const Source& source : scene.sources) text += fmt::format("; a source of {:g} disks per unit time", source.rate);
  return text;
}

std::string sides_text(const Scene& scene) {
  const Domain& box = scene.box;
  std::string text;
  for (const Side side : all_sides) {
    const auto k = static_cast<std::size_t>(side);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", side_names[k],
                        side_kind_names[static_cast<std::size_t>(box.side(side))]);
  }
  if (!scene.walls.empty()) text += "; " + counted(scene.walls.size(), "inner wall");
  const auto sinks = std::count_if(scene.walls.begin(), scene.walls.end(), [](const InnerWall& w) { return w.sink; });
  if (sinks > 0) text += fmt::format(", of which {}", counted(static_cast<Count>(sinks), "sink"));
  return text;
}

}  // namespace carom
