// The disks of a random scene: their properties, their positions, and the size of box they need.
#pragma once

#include <string>
#include <string_view>

#include "tests/fuzz_scenes/dice.hpp"

namespace carom::fuzz {

// A mark in a crowd's text where a group may get a region, for which the box must be known.
inline constexpr std::string_view region_mark = "# region\n";

// Scales of a scene: lengths, masses and speeds are of this order. They are powers of two, so that disks that touch in
// one scale touch in every other.
struct Units {
  double length = 1.0, mass = 1.0, speed = 1.0;
};

// The kind of crowd in a scene.
enum class Cast : std::uint8_t { gas, few, touching, giants, grown, crowd, pile, none };

struct Crowd {
  std::string text;                  // [[disks]] tables
  std::size_t disks = 0;             // of all groups
  double largest = 0.0;              // radius
  double smallest = 0.0;             // radius
  double heaviest = 0.0;             // mass
  double area = 0.0;                 // of all disks, approximately
  double width = 0.0, height = 0.0;  // of the box, if disks are listed one by one; otherwise 0
  double packing_fraction = 0.0;     // that the box should have, if they are not
  bool at_rest = false;
};

Crowd random_crowd(Dice& dice, Cast cast, const Units& units);

// Disks on a lattice, or at random in up to three groups.
Crowd random_gas(Dice& dice, std::size_t disks, const Units& units);

// The lines for radius and mass of a source, or of a group without lists. No radius exceeds `largest`.
std::string random_sizes(Dice& dice, const Units& units, double largest);

}  // namespace carom::fuzz
