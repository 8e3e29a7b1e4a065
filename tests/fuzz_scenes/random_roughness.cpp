#include "tests/fuzz_scenes/random_roughness.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

namespace carom::fuzz {

namespace {

// The value of the key, without braces. perfect: surfaces lose no energy.
std::string roughness_text(Dice& dice, bool perfect) {
  if (perfect) return fmt::format("tangential_restitution = {}", dice.chance(0.8) ? 1.0 : -1.0);
  const double b = dice.chance(0.3) ? dice.pick({-1.0, -0.5, 0.0, 1.0}) : rounded(dice.in(-1.0, 1.0));
  const std::string friction = dice.chance(0.5) ? fmt::format(", friction = {}", rounded(dice.decades(-2, 1))) : "";
  return fmt::format("tangential_restitution = {}{}", b, friction);
}

void insert_after(std::string& text, std::string_view head, const std::string& line, std::size_t from = 0) {
  const std::size_t at = text.find(head, from);
  if (at != std::string::npos) text.insert(at + head.size(), line);
}

}  // namespace

std::string with_rough_disks(Dice& dice, const Units& units, double largest_radius, bool heap, std::string text) {
  const bool perfect = heap && text.find("collapse = ") == std::string::npos;
  const std::string inertia = dice.chance(0.3) ? fmt::format(", inertia = {}", rounded(dice.in(0.01, 1.0))) : "";
  insert_after(text, "[physics]\n", fmt::format("roughness = {{ {}{} }}\n", roughness_text(dice, perfect), inertia));
  if (dice.chance(0.5)) {
    insert_after(text, "[box]\n", fmt::format("wall_roughness = {{ {} }}\n", roughness_text(dice, perfect)));
  }
  const double energy = units.mass * units.speed * units.speed;
  for (const std::string_view head : {"[[disks]]\n", "[[sources]]\n"}) {
    for (std::size_t at = 0; (at = text.find(head, at)) != std::string::npos; ++at) {
      const std::string block = text.substr(at, text.find("\n[", at) - at);
      if (block.find("fixed = true") != std::string::npos || dice.chance(0.4)) continue;
      const double spin = rounded(units.speed / largest_radius * dice.in(-1.0, 1.0));
      insert_after(text, head,
                   dice.chance(0.5) ? fmt::format("spin = {}\n", spin)
                                    : fmt::format("spin_temperature = {}\n", rounded(energy * dice.unit())),
                   at);
    }
  }
  return text;
}

}  // namespace carom::fuzz
