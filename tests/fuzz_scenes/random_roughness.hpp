// Rough disks in a random scene.
#pragma once

#include <string>

#include "tests/fuzz_scenes/dice.hpp"
#include "tests/fuzz_scenes/random_disks.hpp"

namespace carom::fuzz {

// The scene with a roughness, perhaps of walls too, and with spins for some groups and sources. heap: surfaces lose no
// energy, unless the scene has a remedy for the collapse in which it would end.
std::string with_rough_disks(Dice& dice, const Units& units, double largest_radius, bool heap, std::string text);

}  // namespace carom::fuzz
