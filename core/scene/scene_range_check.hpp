// Checks numbers of a scene against the ranges of scene_ranges.hpp if that needs more than one number. All functions
// throw InputError. path: "disks.0" or "sources.0".
#pragma once

#include <string>

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Only one normal deviate in 10^18 is larger.
inline constexpr double largest_deviate = 9.0;

// Sides of the box that were computed from a packing fraction.
void check_box_range(const Scene& scene, const PlaceOfKey& place);

// Positions from a list or a file.
void check_positions(const PositionLaw& law, const std::string& path, const PlaceOfKey& place);

// Speeds, and the distances that they cover until t_end. mass: the smallest of these disks.
void check_velocities(const Scene& scene, const VelocityLaw& law, double mass, const std::string& path,
                      const PlaceOfKey& place);

// Speeds given by a thermostat and thermal sides. smallest_mass: of all moving disks, 0 if there are none.
void check_thermal_sides(const Scene& scene, double smallest_mass, const PlaceOfKey& place);

// The number of disks from a source.
void check_emissions(const Scene& scene, const Source& source, const std::string& path, const PlaceOfKey& place);

// The numbers of steps and frames until t_end, and the motion by gravity and diffusion until then. run.dt need not be
// chosen yet.
void check_times(const Scene& scene, const PlaceOfKey& place);

// The box against the smallest radius.
void check_resolution(const Scene& scene, double smallest_radius, const PlaceOfKey& place);

}  // namespace carom
