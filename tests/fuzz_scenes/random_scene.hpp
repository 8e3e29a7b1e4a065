// Scenes put together at random from everything that a scene file can say, as text: what fails can be saved and run
// again.
#pragma once

#include <cstdint>
#include <string>

namespace carom::fuzz {

// The scene with this number. Not every one can be made (its disks may find no room); the next attempt is another.
// attempt < 256.
std::string random_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt);

// A small scene that the all-pairs oracle can run: disks, walls and periodic sides, gravity, restitution, nothing else.
std::string random_oracle_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt);

}  // namespace carom::fuzz
