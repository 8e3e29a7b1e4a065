#include "tests/fuzz_scenes/random_restitution.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace carom::fuzz {

namespace {

// In a few scenes the restitution of [physics] depends on the speed.
std::string with_viscosity(Dice& dice, const Units& units, double restitution, bool brownian, std::string text) {
  const std::string number = fmt::format("restitution = {}\n", restitution);
  if (brownian || restitution == 1.0 || !dice.chance(0.2)) return text;
  const std::size_t at = text.find(number, text.find("[physics]"));
  const double a = rounded(dice.in(0.01, 0.6) / std::pow(units.speed, 0.2));
  return text.replace(at, number.size(),
                      fmt::format("restitution = {{ viscoelastic = {}, least = {} }}\n", a, restitution));
}

// Gives names to the [[disks]] tables that have none. Returns all names, and those of groups that move.
std::string name_groups(std::string text, std::vector<std::string>& all, std::vector<std::string>& moving) {
  constexpr std::string_view head = "[[disks]]\n", fixed = "fixed = true\n", name = "name = \"";
  for (std::size_t at = 0; (at = text.find(head, at)) != std::string::npos;) {
    at += head.size();
    if (text.compare(at, name.size(), name) == 0) {
      const std::size_t begin = at + name.size();
      all.push_back(text.substr(begin, text.find('"', begin) - begin));
    } else {
      all.push_back(fmt::format("g{}", all.size()));
      text.insert(at, fmt::format("name = \"{}\"\n", all.back()));
    }
    const std::size_t second_line = text.find('\n', at) + 1;
    if (text.compare(second_line, fixed.size(), fixed) != 0) moving.push_back(all.back());
  }
  return text;
}

// In a few scenes pairs of groups have their own restitution.
std::string with_pairs(Dice& dice, const Units& units, bool brownian, std::string text) {
  if (!dice.chance(0.2)) return text;
  std::vector<std::string> all, moving;
  text = name_groups(std::move(text), all, moving);
  for (std::vector<std::string>* names : {&moving, &all}) {
    if (text.find("[[sources]]") != std::string::npos) names->emplace_back("sources");
  }
  if (moving.empty()) return text;
  const std::string& one = moving[dice.below(moving.size())];  // it is in all pairs, so that none is stated twice
  for (const std::string& other : all) {
    if (!dice.chance(0.6)) continue;
    text += fmt::format("[[physics.pairs]]\ngroups = [\"{}\", \"{}\"]\nrestitution = ", one, other);
    if (!brownian && dice.chance(0.3)) {
      text += fmt::format("{{ viscoelastic = {} }}\n", rounded(dice.in(0.01, 0.6) / std::pow(units.speed, 0.2)));
    } else {
      text += fmt::format("{}\n", random_restitution(dice));
    }
  }
  return text;
}

}  // namespace

double random_restitution(Dice& dice) {
  return dice.chance(0.5) ? 1.0 : dice.pick({0.0, 0.2, 0.5, 0.8, 0.9, 0.99, rounded(dice.unit())});
}

std::string with_restitution_laws(Dice& dice, const Units& units, double restitution, bool brownian, std::string text) {
  return with_pairs(dice, units, brownian, with_viscosity(dice, units, restitution, brownian, std::move(text)));
}

}  // namespace carom::fuzz
