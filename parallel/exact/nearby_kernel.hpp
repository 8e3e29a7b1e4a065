// Which disks of some runs are near a place: the kernel of the lists, in the versions that this machine may have.
#pragma once

#include <cstddef>
#include <cstdint>

namespace carom {

// In the chains of disks listed anew: the disk is still in the cell that it was sorted into.
inline constexpr std::uint32_t unchained = 0xfffffffeU;

// A place in the box, rounded down, in 2^-32 of a period or 2^-31 of a side between walls: differences of whole numbers
// wrap round a period by themselves, and lead to the nearest image.
struct Spot {
  std::uint32_t x = 0, y = 0;
};

// Lengths in any one unit, such that squares are numbers in single precision.
struct NearbyFrame {
  Spot spot;
  float unit_x = 0.0F, unit_y = 0.0F;  // a Spot's units; length
  float reach = 0.0F;                  // without the other's radius; length
  float common_radius = 0.0F;          // where all have one; length
  double per_length = 1.0;             // what turns a radius of NearbyColumns into the unit of the others
  std::uint32_t self = 0;              // is not looked for
};

// By storage index.
struct NearbyColumns {
  const Spot* spot = nullptr;
  const double* radius = nullptr;       // null: all have the common one
  const std::uint32_t* next = nullptr;  // only those that are unchained here are looked for; null: all
  std::uint32_t count = 0;              // of disks that may be read, looked for or not
};

// Disks [first, last), neighbours in storage.
struct DiskRun {
  std::uint32_t first, last;
};

// In this order, so that all versions give the same.
inline bool is_nearby(const NearbyFrame& f, Spot s, float radius) {
  const float dx = static_cast<float>(static_cast<std::int32_t>(s.x - f.spot.x)) * f.unit_x;
  const float dy = static_cast<float>(static_cast<std::int32_t>(s.y - f.spot.y)) * f.unit_y;
  const float reach = f.reach + radius;
  return dx * dx + dy * dy <= reach * reach;
}
inline float radius_in(const NearbyFrame& f, const NearbyColumns& columns, std::uint32_t j) {
  return columns.radius != nullptr ? static_cast<float>(columns.radius[j] * f.per_length) : f.common_radius;
}

// Writes those of the disks of the runs that are nearby, in order, and returns how many. found has room for all of them
// and nearby_room more.
inline constexpr std::size_t nearby_room = 8;
using NearbyKernel = std::size_t (*)(const NearbyFrame& frame, const NearbyColumns& columns, const DiskRun* runs,
                                     std::size_t count, std::uint32_t* found);

std::size_t nearby_baseline(const NearbyFrame& frame, const NearbyColumns& columns, const DiskRun* runs,
                            std::size_t count, std::uint32_t* found);
std::size_t nearby_avx2(const NearbyFrame& frame, const NearbyColumns& columns, const DiskRun* runs, std::size_t count,
                        std::uint32_t* found);

// The best version for the processor at hand.
NearbyKernel choose_nearby_kernel();

}  // namespace carom
