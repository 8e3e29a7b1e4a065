// Restitutions of a random scene, numbers and laws.
#pragma once

#include <string>

#include "tests/fuzz_scenes/dice.hpp"
#include "tests/fuzz_scenes/random_disks.hpp"

namespace carom::fuzz {

double random_restitution(Dice& dice);

// The scene with this restitution in [physics], possibly replaced by one that depends on the speed, and with pairs of
// groups that have their own. brownian: velocities are drawn, so no law may depend on speed.
std::string with_restitution_laws(Dice& dice, const Units& units, double restitution, bool brownian, std::string text);

}  // namespace carom::fuzz
