#include "core/load/brownian_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/scene/drawn_velocities.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/size_law.hpp"

namespace carom {

namespace {

// May two disks that can meet have masses that differ by more than rounding?
bool masses_differ(const Scene& scene) {
  SizeRange all{HUGE_VAL, 0.0};
  const auto see = [&](const SizeLaw& radius, const SizeLaw& mass) {
    const auto [smallest, largest] = ends_of_sizes(radius, mass);
    all = {std::min(all.low, smallest.mass), std::max(all.high, largest.mass)};
  };
  for (const DiskGroup& group : scene.groups) {
    if (!group.fixed && group.count > 0) see(group.radius, group.mass);
  }
  for (const Source& source : scene.sources) see(source.radius, source.mass);
  constexpr double rounding = 1e-9;
  return all.high > (1.0 + rounding) * all.low;
}

// The key of the first group or source with initial velocities that are not random around 0; empty if there is none.
// Velocities of disks that enter through a side do not count: they must point inwards.
std::string key_of_motion(const Scene& scene) {
  const auto moves = [](const Vec2& v) { return v.x != 0.0 || v.y != 0.0; };
  for (std::size_t k = 0; k < scene.groups.size(); ++k) {
    const DiskGroup& group = scene.groups[k];
    if (group.fixed || group.count == 0) continue;
    if (moves(group.drift)) return fmt::format("disks.{}.drift", k);
    const std::vector<Vec2>& given = group.velocities.list;
    if (std::any_of(given.begin(), given.end(), moves)) return fmt::format("disks.{}.velocities", k);
  }
  for (std::size_t k = 0; k < scene.sources.size(); ++k) {
    const VelocityLaw& law = scene.sources[k].velocities;
    if (scene.sources[k].side && std::max(law.temperature, law.limit) > 0.0)
      return fmt::format("sources.{}.velocities", k);
  }
  return "";
}

// The box's wall_restitution, if it can be inferred: sides that are not walls have it, or all walls but one share it.
std::optional<double> common_restitution(const Domain& box) {
  for (const Side side : all_sides) {
    if (box.side(side) != SideKind::wall) return box.restitution(side);
  }
  for (const double r : box.restitutions) {
    if (std::count(box.restitutions.begin(), box.restitutions.end(), r) >= 3) return r;
  }
  return {};
}

// The keys of the sides that dissipate, each its own.
std::string keys_of_losing_sides(const Domain& box) {
  std::vector<std::string> keys;
  for (const Side side : all_sides) {
    if (box.side(side) != SideKind::wall || !(box.restitution(side) < 1.0)) continue;
    keys.push_back(fmt::format("box.{}.restitution", side_names[static_cast<std::size_t>(side)]));
  }
  return fmt::format("{}", fmt::join(keys, ", "));
}

// The first key that makes a contact dissipate, empty if there is none; several keys if it cannot be known which of
// them set a side's restitution.
std::string key_of_loss(const Scene& scene) {
  const std::optional<double> common = common_restitution(scene.box);
  const auto key_of_wall = [&](double restitution, const std::string& own) {
    return restitution == *common ? "box.wall_restitution" : own + ".restitution";
  };
  if (scene.physics.restitution < 1.0) return "physics.restitution";
  if (scene.physics.law.dissipates()) return "physics.pairs";
  if (!common) return keys_of_losing_sides(scene.box);
  for (const Side side : all_sides) {
    const double restitution = scene.box.restitution(side);
    if (scene.box.side(side) != SideKind::wall || !(restitution < 1.0)) continue;
    return key_of_wall(restitution, fmt::format("box.{}", side_names[static_cast<std::size_t>(side)]));
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const double restitution = scene.walls[k].restitution;
    if (restitution < 1.0) return key_of_wall(restitution, fmt::format("walls.{}", k));
  }
  return "";
}

}  // namespace

std::vector<std::string> brownian_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  if (!velocities_are_drawn(scene)) return warnings;
  const auto warn = [&](std::string_view key, const std::string& what) {
    warnings.push_back(fmt::format("{}: {}: Brownian disks have no velocities, only a displacement u in each step: {}",
                                   scene.file, key, what));
  };
  const auto& plots = scene.output.plots;
  if (std::find(plots.begin(), plots.end(), "energy") != plots.end()) warn("output.plots", "no energies are plotted");
  if (scene.analysis.wants(Quantity::pressure)) warn("analysis.what", "no pressure is measured");
  if (scene.analysis.wants(Quantity::collision_rate)) {
    warn("analysis.what", "collisions are those of disks that move at u / dt, and their number grows as 1 / sqrt(dt)");
  }
  if (scene.analysis.wants(Quantity::speeds)) warn("analysis.what", "the speeds are those of u / dt");
  if (scene.analysis.wants(Quantity::profile)) {
    warn("analysis.what", "the velocities and the temperature of the profile are those of u / dt");
  }
  if (scene.analysis.wants(Quantity::velocity_autocorrelation)) {
    warn("analysis.what", "the autocorrelation is that of u / dt");
  }
  if (const std::string key = key_of_motion(scene); !key.empty()) {
    warn(key, "the velocities given here are forgotten in the first step, and the disks do not drift");
  }
  if (const std::string key = key_of_loss(scene); !key.empty()) {
    warn(key, fmt::format("with a value below 1 disks stay too close after a collision, and their density within "
                          "sqrt(2 D dt) = {:.3g} of contact is too high; use 1",
                          std::sqrt(2.0 * scene.physics.diffusion * scene.run.dt)));
  }
  if (scene.physics.gravity.acts()) {
    warn("physics.gravity",
         fmt::format("the velocity that gravity adds in a step is forgotten in the next, so disks sink at only g dt / "
                     "2 = {:.3g}, and more slowly with a smaller dt, and do not follow the barometric law",
                     0.5 * scene.physics.gravity.size * scene.run.dt));
  }
  if (masses_differ(scene)) {
    warn("disks.mass",
         "D is the same for all disks, but in a collision the lighter disk is displaced further; use equal masses, "
         "otherwise heavy disks spread faster");
  }
  return warnings;
}

}  // namespace carom
