// Rough disks in a random scene.
#pragma once

#include <string>

#include "tests/fuzz_scenes/dice.hpp"
#include "tests/fuzz_scenes/random_disks.hpp"

namespace carom::fuzz {

// The scene with rough disks, possibly also rough walls, and with spins for some groups and sources. heap: surfaces
// lose no energy, unless the scene has a remedy for the collapse that would follow.
std::string with_rough_disks(Dice& dice, const Units& units, double largest_radius, bool heap, std::string text);

}  // namespace carom::fuzz
