// The kernels of the neighbour lists: they find the disks near a position in some blocks of cells, and the changes of a
// list. There is one version for each instruction set.
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

// A search for the neighbours of a disk. Lengths are in units of the coarser coordinate of a SlotPosition.
struct ListQuery {
  SlotPosition position;
  std::int16_t unit_x = 0, unit_y = 0;  // the steps of a SlotPosition, in 2^-15 of that unit
  float cutoff = 0.0F;                  // without the sum of the two radii; length
  float radius = 0.0F;                  // of the disk, or of all disks; length
  std::uint32_t self = 0;               // the disk itself, which is not its own neighbour
};
// Coordinates are rounded to whole units, so the distance of two places is off by at most this; length.
inline constexpr double list_kernel_rounding = 2.2;

inline constexpr std::uint32_t empty_slot = 0xffffffffU;
inline constexpr std::uint32_t slots_a_cell = 8;
// The slots of a cell, in one cache line.
struct alignas(64) SlotCell {
  SlotPosition position[slots_a_cell];
  std::uint32_t disk[slots_a_cell];  // empty_slot: none
};
// The slots of all cells.
struct SlotColumns {
  const SlotCell* cell = nullptr;
  const float* radius = nullptr;  // by slot, those of a cell one after the other; length, as in the query; null: all
                                  // have the common one
};
// A rectangle of cells: in each of its rows `width` successive cells, which begin `stride` cells after those of the
// previous row. Neither side is empty.
struct CellBlock {
  std::uint32_t first, width, rows, stride;
};

// All versions do these operations in this order, so they find the same disks, and of two neighbours each finds the
// other.
inline bool is_neighbour(const ListQuery& q, SlotPosition p, float radius) {
  const auto distance = [](std::uint16_t a, std::uint16_t b, std::int16_t unit) {
    const int difference = static_cast<std::int16_t>(static_cast<std::uint16_t>(a - b));
    return ((difference < 0 ? -difference : difference) * unit + 0x4000) >> 15;
  };
  const int dx = distance(p.x, q.position.x, q.unit_x);
  const int dy = distance(p.y, q.position.y, q.unit_y);
  // The two radii are added first: the sum is the same for both disks of a pair.
  const float cutoff = q.cutoff + (q.radius + radius);
  return static_cast<float>(dx * dx + dy * dy) <= cutoff * cutoff;
}

// Writes the neighbours among the disks in the slots of a block, in order, and returns their number. `found` has room
// for all slots and list_kernel_padding more.
inline constexpr std::size_t list_kernel_padding = 8;
using ListKernel = std::size_t (*)(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                                   std::uint32_t* found);

std::size_t list_kernel_baseline(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                                 std::uint32_t* found);
[[gnu::hot]] std::size_t list_kernel_avx2(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                                          std::uint32_t* found);

// The difference between the old list in a row and the new one.
struct ListChange {
  bool fits = true;               // if false, the new list does not fit in a row, and the rest means nothing
  std::uint32_t stay = 0;         // bit k: the neighbour at place k of the old list is in the new one
  std::uint32_t fresh_count = 0;  // the number of new neighbours that are not in the old list
};

// Where the new list is written. offset: all its offsets, with room for row_offsets. fresh: its disks that are not in
// the old list, with room for one more than these.
struct NewList {
  std::int16_t* offset;
  std::uint32_t* fresh;
};

// row: disk i's old list, of `count` neighbours. near[0] to near[new_count - 1]: the new list, without i itself.
using ChangeKernel = ListChange (*)(const void* row, std::uint32_t count, std::uint32_t i, const std::uint32_t* near,
                                    std::size_t new_count, const NewList& to);

ListChange change_kernel_baseline(const void* row, std::uint32_t count, std::uint32_t i, const std::uint32_t* near,
                                  std::size_t new_count, const NewList& to);
[[gnu::hot]] ListChange change_kernel_avx2(const void* row, std::uint32_t count, std::uint32_t i,
                                           const std::uint32_t* near, std::size_t new_count, const NewList& to);

// Adds disk i to the rows of disks with room for it, or removes it from the rows of disks that have it. Returns the
// number of remaining disks, whose rows it has not changed; they are then the first ones of `disks`. Offsets beyond a
// list, up to the next multiple of `row_padding` places, are equal to offsets of the list.
using EditKernel = std::uint32_t (*)(ListRow* rows, std::uint32_t i, std::uint32_t* disks, std::uint32_t count);
struct EditKernels {
  EditKernel insert, remove;
};

// The baseline leaves all disks to the caller.
EditKernels edit_kernels_baseline();
EditKernels edit_kernels_avx2();

// The best versions for the processor in use.
ListKernel choose_list_kernel();
ChangeKernel choose_change_kernel();
EditKernels choose_edit_kernels();

}  // namespace carom
