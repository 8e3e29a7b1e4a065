// The disks of a random scene: what they are, where they stand, and how large a box they need.
#pragma once

#include <string>
#include <string_view>

#include "tests/fuzz_scenes/dice.hpp"

namespace carom::fuzz {

// Stands in a crowd's text where a group may have a region, for which the box must be known.
inline constexpr std::string_view region_mark = "# region\n";

// Scales of a scene: lengths, masses and speeds are of the order of these. Powers of two, so that disks which touch in
// one scale touch in every other.
struct Units {
  double length = 1.0, mass = 1.0, speed = 1.0;
};

// What kind of crowd a scene is.
enum class Cast : std::uint8_t { gas, few, touching, giants, grown, crowd, pile, none };

struct Crowd {
  std::string text;                  // [[disks]] tables
  std::size_t disks = 0;             // of all groups
  double largest = 0.0;              // radius
  double smallest = 0.0;             // radius
  double heaviest = 0.0;             // mass
  double area = 0.0;                 // of all disks, about
  double width = 0.0, height = 0.0;  // of the box, where disks are listed one by one; else 0
  double packing_fraction = 0.0;     // to have, where they are not
  bool at_rest = false;
};

Crowd random_crowd(Dice& dice, Cast cast, const Units& units);

// On a lattice, or at random in up to three groups.
Crowd random_gas(Dice& dice, std::size_t disks, const Units& units);

// radius and mass lines of a source or a group without lists; largest is the radius not to exceed.
std::string random_sizes(Dice& dice, const Units& units, double largest);

}  // namespace carom::fuzz
