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

// The least and the largest value of a law, up to rounding. Precondition: it is not from_other.
struct SizeRange {
  double low = 0.0, high = 0.0;
};
SizeRange size_range(const SizeLaw& law);

// Do all disks get the same radius and mass?
bool same_for_all(const SizeLaw& radius, const SizeLaw& mass);

// Sums over the sizes of a group, computed without storing them.
struct SizeSummary {
  DiskSize smallest, largest;             // smallest and largest radius and mass, each by itself; 0 for an empty group
  double radius_squared = 0.0;            // sum of r^2, in id order
  double mass = 0.0, inverse_mass = 0.0;  // sums of m and of 1 / m, in id order; meaningless for fixed disks
};
SizeSummary summarise_sizes(const DiskGroup& group, std::uint64_t seed, DiskId first_id);

// The least and the largest radius and mass from these laws. Precondition: not both are from_other.
std::pair<DiskSize, DiskSize> ends_of_sizes(const SizeLaw& radius, const SizeLaw& mass);

}  // namespace carom
