// The kernels of the neighbour lists: which disks of some runs of slots are near a position, and how a list changes.
// One version for each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "parallel/exact/list_row.hpp"

namespace carom {

// The part of a listed position that a slot holds: 16 bits of each coordinate, the same ones for all disks. Differences
// wrap round along a period here too; those of places that are far from each other mean nothing.
struct SlotPosition {
  std::uint16_t x = 0, y = 0;
};

// Lengths are in units of the coarser coordinate of a SlotPosition.
struct ListQuery {
  SlotPosition position;
  std::int16_t unit_x = 0, unit_y = 0;  // the steps of a SlotPosition, in 2^-15 of that unit
  float cutoff = 0.0F;                  // without the two radii; length
  float radius = 0.0F;                  // of the disk, or of all disks; length
  std::uint32_t self = 0;               // is not its own neighbour
};
// Coordinates are whole numbers of units, so that the distance of two places is off by at most this; length.
inline constexpr double list_kernel_rounding = 2.2;

inline constexpr std::uint32_t empty_slot = 0xffffffffU;
inline constexpr std::uint32_t slots_a_cell = 8;
// The slots of a cell: a cache line.
struct alignas(64) SlotCell {
  SlotPosition position[slots_a_cell];
  std::uint32_t disk[slots_a_cell];  // empty_slot: none
};
// Of all cells.
struct SlotColumns {
  const SlotCell* cell = nullptr;
  const float* radius = nullptr;  // by slot, those of a cell one after the other; length, as in the query; null: all
                                  // have the common one
};
// A rectangle of cells: in each of its rows, `width` cells one after the other, `stride` cells on from those of the row
// before. Neither side is empty.
struct CellBlock {
  std::uint32_t first, width, rows, stride;
};

// All versions do these operations in this order. So they find the same disks, and of two disks each finds the other.
inline bool is_neighbour(const ListQuery& q, SlotPosition p, float radius) {
  const auto distance = [](std::uint16_t a, std::uint16_t b, std::int16_t unit) {
    const int difference = static_cast<std::int16_t>(static_cast<std::uint16_t>(a - b));
    return ((difference < 0 ? -difference : difference) * unit + 0x4000) >> 15;
  };
  const int dx = distance(p.x, q.position.x, q.unit_x);
  const int dy = distance(p.y, q.position.y, q.unit_y);
  // The sum of the radii first: it is the same for both of a pair.
  const float cutoff = q.cutoff + (q.radius + radius);
  return static_cast<float>(dx * dx + dy * dy) <= cutoff * cutoff;
}

// Writes the neighbours among the disks in the slots of a block, in order, and returns how many. found has room for
// as many as there are slots, and list_kernel_padding more.
inline constexpr std::size_t list_kernel_padding = 8;
using ListKernel = std::size_t (*)(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                                   std::uint32_t* found);

std::size_t list_kernel_baseline(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                                 std::uint32_t* found);
[[gnu::hot]] std::size_t list_kernel_avx2(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                                          std::uint32_t* found);

// How a list in a row differs from the new one that takes its place.
struct ListChange {
  bool fits = true;               // otherwise the rest means nothing: the new list does not fit in a row
  std::uint32_t stay = 0;         // bit k: the neighbour at place k of the old list is in the new one
  std::uint32_t fresh_count = 0;  // how many of the new list are not in the old one
};

// Where the new list is written: offset, all its offsets, with room for row_offsets; fresh, its disks that are not in
// the old list, with room for one more than that.
struct NewList {
  std::int16_t* offset;
  std::uint32_t* fresh;
};

// row: disk i's old list, of `count` neighbours; near[0] to near[new_count - 1]: the new one, without i itself.
using ChangeKernel = ListChange (*)(const void* row, std::uint32_t count, std::uint32_t i, const std::uint32_t* near,
                                    std::size_t new_count, const NewList& to);

ListChange change_kernel_baseline(const void* row, std::uint32_t count, std::uint32_t i, const std::uint32_t* near,
                                  std::size_t new_count, const NewList& to);
[[gnu::hot]] ListChange change_kernel_avx2(const void* row, std::uint32_t count, std::uint32_t i,
                                           const std::uint32_t* near, std::size_t new_count, const NewList& to);

// Adds disk i to the rows of some disks that have room for it, or removes it from the rows of those that have it.
// Returns how many of the disks are left to do; they are then the first ones of `disks`. Offsets beyond a list, up to
// the next multiple of `row_padding` places, are ones that it has.
using EditKernel = std::uint32_t (*)(ListRow* rows, std::uint32_t i, std::uint32_t* disks, std::uint32_t count);
struct EditKernels {
  EditKernel insert, remove;
};

// The baseline leaves all of them to do.
EditKernels edit_kernels_baseline();
EditKernels edit_kernels_avx2();

// The best versions for the processor at hand.
ListKernel choose_list_kernel();
ChangeKernel choose_change_kernel();
EditKernels choose_edit_kernels();

}  // namespace carom
