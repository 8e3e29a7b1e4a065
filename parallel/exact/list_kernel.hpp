// The kernel of the neighbour lists: which disks of some runs are near a position. One version for each instruction
// set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace carom {

// In the chains of relisted disks: the disk is still in the cell that it was sorted into.
inline constexpr std::uint32_t unchained = 0xfffffffeU;

// A position in the box, rounded down, in 2^-32 of a period or 2^-31 of a side between walls: differences of whole
// numbers wrap round a period by themselves, which gives the nearest image.
struct FixedPointPosition {
  std::uint32_t x = 0, y = 0;
};

// Lengths in any one unit, such that squares are numbers in single precision.
struct ListQuery {
  FixedPointPosition position;
  float unit_x = 0.0F, unit_y = 0.0F;  // of FixedPointPosition; length
  float cutoff = 0.0F;                 // without the neighbour's radius; length
  float common_radius = 0.0F;          // where all disks have one; length
  double per_length = 1.0;             // converts a radius of ListColumns to this unit
  std::uint32_t self = 0;              // is not its own neighbour
};

// By storage index.
struct ListColumns {
  const FixedPointPosition* position = nullptr;
  const double* radius = nullptr;       // null: all have the common one
  const std::uint32_t* next = nullptr;  // only disks that are unchained here are found; null: all
  std::uint32_t count = 0;              // of disks that may be read, found or not
};

// Disks [first, last), neighbours in storage.
struct DiskRun {
  std::uint32_t first, last;
};

// All versions do these operations in this order, so that they find the same disks.
inline bool is_neighbour(const ListQuery& q, FixedPointPosition p, float radius) {
  const float dx = static_cast<float>(static_cast<std::int32_t>(p.x - q.position.x)) * q.unit_x;
  const float dy = static_cast<float>(static_cast<std::int32_t>(p.y - q.position.y)) * q.unit_y;
  const float cutoff = q.cutoff + radius;
  return dx * dx + dy * dy <= cutoff * cutoff;
}
inline float radius_in(const ListQuery& q, const ListColumns& columns, std::uint32_t j) {
  return columns.radius != nullptr ? static_cast<float>(columns.radius[j] * q.per_length) : q.common_radius;
}

// Writes the neighbours among the disks of the runs, in order, and returns how many. found has room for all disks of
// the runs and list_kernel_padding more.
inline constexpr std::size_t list_kernel_padding = 8;
using ListKernel = std::size_t (*)(const ListQuery& query, const ListColumns& columns, const DiskRun* runs,
                                   std::size_t count, std::uint32_t* found);

std::size_t list_kernel_baseline(const ListQuery& query, const ListColumns& columns, const DiskRun* runs,
                                 std::size_t count, std::uint32_t* found);
std::size_t list_kernel_avx2(const ListQuery& query, const ListColumns& columns, const DiskRun* runs, std::size_t count,
                             std::uint32_t* found);

// The best version for the processor at hand.
ListKernel choose_list_kernel();

}  // namespace carom
