// Reads the laws of positions, velocities, radii and masses of groups and sources.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The value of "positions" of a group: a name, a list of [x, y], { file = "p.csv" } or { frame = "DIR" }, which are
// read in, and of "region", the part of the box that random places and lattices keep to. The other laws take { frame =
// ... } likewise. Throws InputError for anything else, for a missing key, and for a CSV file that cannot be read.
PositionLaw read_positions(const TableReader& group);

// The disks that a law is for: a group's, which may have a list, or a source's, whose number is not known.
enum class Serves : std::uint8_t { a_group, any_number };

// The value of "velocities": { maxwell = T }, { uniform = v }, a list, { file = ... }; at rest when absent.
VelocityLaw read_velocities(const TableReader& owner, Serves serves);

// The spins of the disks in { frame = ... }; 0 if disks were smooth. file is set to its name in messages.
std::vector<double> read_spins_of_frame(const TableReader& owner, const toml::table& table, std::string& file);

// The value of "drift", [vx, vy]; 0 when absent.
Vec2 read_drift(const TableReader& group);

// The value of "radius" or "mass" (name): a number, a list, { uniform = [low, high] }, a distribution, or other_key =
// density, where other_key is "from_mass" for radii and "from_radius" for masses.
SizeLaw read_size(const TableReader& owner, std::string_view name, std::string_view other_key, Serves serves);

}  // namespace carom
