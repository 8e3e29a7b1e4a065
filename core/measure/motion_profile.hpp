// Profiles of mean velocity and temperature along an axis, slab by slab.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// Equal slabs across the box; sums over the disks with their centre in each, and over the samples.
struct MotionProfile {
  std::vector<Count> disks;
  std::vector<double> mass;
  std::vector<double> px, py;         // m v
  std::vector<double> twice_thermal;  // m (v - V)^2, V the mean velocity over all disks and samples of the slab
  Count samples = 0;
};

MotionProfile empty_profile(std::size_t slabs);

// Sums run in order of ids: the same bits for any storage order.
void add_motion(MotionProfile& profile, const DisksInPieces& disks, const Domain& box, bool along_x);
inline void add_motion(MotionProfile& profile, const Disks& disks, const Domain& box, bool along_x) {
  add_motion(profile, WholeDisks(disks, 0.0), box, along_x);
}

// Adds the samples of another profile with as many slabs.
void join(MotionProfile& profile, const MotionProfile& other);

// Slab k: the mean velocity V of all its disks and samples, and the temperature, sum of m (v - V)^2 / 2 over the number
// of disks. NaN if there was no disk.
struct SlabMotion {
  Vec2 velocity;
  double temperature = 0.0;
};
SlabMotion motion_of_slab(const MotionProfile& profile, std::size_t k);

}  // namespace carom
