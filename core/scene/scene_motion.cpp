#include "core/scene/scene_motion.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "core/base/short_number.hpp"

namespace carom {

namespace {

constexpr std::string_view motion_expected = "expected { velocity = [vx, vy] } or { vibrate = [ax, ay], period = T }";

}  // namespace

TableReader motion_table(const TableReader& owner, std::string_view kind) {
  const toml::node& node = *owner.find("motion");
  const toml::table* table = node.as_table();
  if (table == nullptr) owner.fail("motion", fmt::format("is {}", type_name(node)), motion_expected);
  return {owner.origin(), owner.key("motion"), *table, kind};
}

MotionKeys read_motion_keys(const TableReader& owner, const TableReader& motion) {
  const bool steady = motion.find("velocity") != nullptr;
  if (steady == (motion.find("vibrate") != nullptr)) {
    owner.fail("motion", steady ? "has both velocity and vibrate" : "has neither velocity nor vibrate",
               motion_expected);
  }
  MotionKeys keys;
  const bool sine = motion.choice_or_initial("shape") == 1;
  keys.kind = steady ? SideMotion::Kind::steady : sine ? SideMotion::Kind::sine : SideMotion::Kind::parabolas;
  keys.name = steady ? "velocity" : "vibrate";
  const std::vector<double> v = as_numbers(motion.origin(), motion.key(keys.name), *motion.find(keys.name));
  if (v.size() != 2) motion.fail(keys.name, "has " + counted(v.size(), "number"), "expected a list of two, x and y");
  keys.value = {v[0], v[1]};
  const std::optional<double> period = motion.number("period");
  for (const std::string_view of_vibration : {"period", "shape"}) {
    if (!steady || motion.find(of_vibration) == nullptr) continue;
    motion.fail(of_vibration, "cannot be used with a constant velocity",
                "expected vibrate = [ax, ay] instead of velocity");
  }
  if (!steady && !period) motion.fail("period", "missing", "expected the period of the vibration");
  keys.period = period.value_or(0.0);
  return keys;
}

}  // namespace carom
