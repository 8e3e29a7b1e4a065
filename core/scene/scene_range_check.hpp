// The numbers of a scene against the ranges of scene_ranges.hpp, where the reader cannot tell from one of them alone.
// All throw InputError; path is "disks.0" or "sources.0".
#pragma once

#include <string>

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// No normal deviate is larger, but for one in 10^18.
inline constexpr double largest_deviate = 9.0;

// Sides that came out of a packing fraction.
void check_box_range(const Scene& scene, const PlaceOfKey& place);

// Positions of a list, or of a file.
void check_positions(const PositionLaw& law, const std::string& path, const PlaceOfKey& place);

// Speeds, by themselves and against box and t_end. mass: the smallest that goes with them.
void check_velocities(const Scene& scene, const VelocityLaw& law, double mass, const std::string& path,
                      const PlaceOfKey& place);

// Speeds that a thermostat and thermal sides give. smallest_mass: of all disks that move, 0 if there are none.
void check_thermal_sides(const Scene& scene, double smallest_mass, const PlaceOfKey& place);

// How many disks a source has to give.
void check_emissions(const Scene& scene, const Source& source, const std::string& path, const PlaceOfKey& place);

// Steps and frames until t_end, and what gravity and Brownian motion do until then; run.dt may be still to be chosen.
void check_times(const Scene& scene, const PlaceOfKey& place);

// The box against the smallest radius.
void check_resolution(const Scene& scene, double smallest_radius, const PlaceOfKey& place);

}  // namespace carom
