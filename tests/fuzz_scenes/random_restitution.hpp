// Restitutions of a random scene, numbers and laws.
#pragma once

#include <string>

#include "tests/fuzz_scenes/dice.hpp"
#include "tests/fuzz_scenes/random_disks.hpp"

namespace carom::fuzz {

double random_restitution(Dice& dice);

// The scene, whose [physics] has this restitution, perhaps with one that depends on the speed in its place, and with
// pairs of groups that have their own. brownian: its velocities are drawn, and no law of speeds is allowed.
std::string with_restitution_laws(Dice& dice, const Units& units, double restitution, bool brownian, std::string text);

}  // namespace carom::fuzz
