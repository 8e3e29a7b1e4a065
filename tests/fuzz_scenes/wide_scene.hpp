// Random scenes of the kinds in which collisions were once lost: flat and small boxes with long walls through them,
// small disks in clusters beside large ones, cold flows and jets, obstacles of very unequal sizes at borders and
// corners, gases from very dilute to crowded.
#pragma once

#include <cstdint>
#include <string>

namespace carom::fuzz {

// As for random_scene and random_oracle_scene.
std::string wide_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt);
std::string wide_oracle_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt);

}  // namespace carom::fuzz
