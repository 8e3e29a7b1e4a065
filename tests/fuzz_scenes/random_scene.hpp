// Random scenes with all features of a scene file, as text, so that failing scenes can be saved and run again.
#pragma once

#include <cstdint>
#include <string>

namespace carom::fuzz {

// The scene with this number. Not every scene can be made (there may be no room for its disks); then the next attempt
// is used. attempt < 256.
std::string random_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt);

// A small scene that the oracle can run: disks, walls and periodic sides, gravity, restitution, nothing else.
std::string random_oracle_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt);

}  // namespace carom::fuzz
