// A disk's neighbour list in one cache line.
#pragma once

#include <cstddef>
#include <cstdint>

namespace carom {

// A position in the box, rounded down, in units of 2^-32 of a period or 2^-31 of a side between walls: differences of
// whole numbers wrap round a period by themselves, which gives the nearest image.
struct FixedPointPosition {
  std::uint32_t x = 0, y = 0;
};

// The capacity of a row. Most neighbours are stored so near that offsets to them fit in 16 bits.
inline constexpr std::uint32_t row_offsets = 24;
// Offsets beyond a list, up to the next multiple of this number of places, are equal to offsets of the list.
inline constexpr std::uint32_t row_padding = 4;

// Row i of ListRows: the neighbours of disk i are disks i + offset[k], k < count; any others are in wide rows.
struct alignas(64) ListRow {
  static constexpr std::uint32_t none = 0xffffffffU;
  std::uint32_t more = none;  // number of a wide row of its block
  std::uint8_t count = 0;
  // Bits (1 << side) of the walls and sinks that the disk can touch while it stays listed, and the bits below.
  std::uint8_t sides = 0;
  std::uint16_t block = 0;  // its tile, if there are regions
  FixedPointPosition listed_at;
  std::int16_t offset[row_offsets] = {};

  // A neighbour may be listed across a border along a period.
  static constexpr unsigned across = 1U << 4;
  // There is a wide row: `more` says so too, but all these bits are tested together.
  static constexpr unsigned has_more = 1U << 5;
  // The disk can touch an inner wall, an inner sink or a fixed disk.
  static constexpr unsigned obstacle_near = 1U << 6;
  // A neighbour may be listed across the bottom or the top of a sheared box, whose images move.
  static constexpr unsigned images_move = 1U << 7;
  // Bits of `sides` with which the prediction kernel alone cannot find the disk's first event.
  static constexpr unsigned not_plain = images_move | obstacle_near | has_more | (across - 1U);
  // While they stay listed, are the disk and its neighbours on the same side of each border along a period?
  bool is_inside() const { return (sides & across) == 0; }
};
static_assert(sizeof(ListRow) == 64);
// The first offset is this number of offsets behind the row's start.
inline constexpr std::uint32_t places_before_offsets = 8;
static_assert(offsetof(ListRow, offset) == places_before_offsets * sizeof(std::int16_t));

}  // namespace carom
