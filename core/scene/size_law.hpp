// Radii and masses drawn from their laws.
#pragma once

#include <utility>

#include "core/base/random.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct DiskSize {
  double radius = 0.0;  // length
  double mass = 0.0;
};

// Radius and mass of the k-th disk (from 0) of a group or source: a function of (seed, stream, id) and k alone.
// radius from mass: r = sqrt(m / (pi density)); mass from radius: m = pi density r^2.
// Preconditions: k lies within the lists; not both laws are from_other.
DiskSize draw_size(const SizeLaw& radius, const SizeLaw& mass, std::uint64_t seed, Stream radius_stream,
                   Stream mass_stream, DiskId id, Count k);

// The least and the largest that a law can give, rounding aside. Precondition: it is not from_other.
struct SizeRange {
  double low = 0.0, high = 0.0;
};
SizeRange size_range(const SizeLaw& law);

// True when every disk gets the same radius and mass, so that one draw tells them all.
bool same_for_all(const SizeLaw& radius, const SizeLaw& mass);

// What a group's sizes amount to, without storing them.
struct SizeSummary {
  DiskSize smallest, largest;             // smallest and largest radius and mass, each by itself; 0 for an empty group
  double radius_squared = 0.0;            // sum of r^2, in id order
  double mass = 0.0, inverse_mass = 0.0;  // sums of m and of 1 / m, likewise; a fixed disk's are without meaning
};
SizeSummary summarise_sizes(const DiskGroup& group, std::uint64_t seed, DiskId first_id);

// The least and the largest radius and mass that a group or a source with these laws can give. Precondition: not both
// are from_other.
std::pair<DiskSize, DiskSize> ends_of_sizes(const SizeLaw& radius, const SizeLaw& mass);

}  // namespace carom
