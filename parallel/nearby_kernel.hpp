// Which disks of a run are near a place: the kernel of the lists, in the versions that this machine may have.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/types.hpp"

namespace carom {

// In the chains of disks listed anew: the disk is still in the cell that it was sorted into.
inline constexpr std::uint32_t unchained = 0xfffffffeU;

struct NearbyFrame {
  Vec2 place;                                  // length
  double reach = 0.0;                          // without the other's radius; length
  double common_radius = 0.0;                  // where all have one
  double width = 0.0, height = 0.0;            // periods; 0: none
  double half_width = 0.0, half_height = 0.0;  // infinite where there is no period
  std::uint32_t self = 0;                      // is not looked for
};

// By storage index.
struct NearbyColumns {
  const Vec2* place = nullptr;
  const double* radius = nullptr;       // null: all have the common one
  const std::uint32_t* next = nullptr;  // only those that are unchained here are looked for; null: all
  std::uint32_t count = 0;              // of disks that may be read, looked for or not
};

inline bool is_nearby(const NearbyFrame& f, Vec2 q, double radius) {
  double dx = std::abs(q.x - f.place.x);
  double dy = std::abs(q.y - f.place.y);
  dx -= dx > f.half_width ? f.width : 0.0;
  dy -= dy > f.half_height ? f.height : 0.0;
  const double reach = f.reach + radius;
  return dx * dx + dy * dy <= reach * reach;
}

// Writes those of disks [first, last) that are nearby, in order, and returns how many. found has room for all of them
// and nearby_room more.
inline constexpr std::size_t nearby_room = 4;
using NearbyKernel = std::size_t (*)(const NearbyFrame& frame, const NearbyColumns& columns, std::uint32_t first,
                                     std::uint32_t last, std::uint32_t* found);

std::size_t nearby_baseline(const NearbyFrame& frame, const NearbyColumns& columns, std::uint32_t first,
                            std::uint32_t last, std::uint32_t* found);
std::size_t nearby_avx2(const NearbyFrame& frame, const NearbyColumns& columns, std::uint32_t first, std::uint32_t last,
                        std::uint32_t* found);

// The best version for the processor at hand.
NearbyKernel choose_nearby_kernel();

}  // namespace carom
