// The neighbour lists in memory: for each disk a row of the storage offsets to its neighbours, with the position at
// which it is listed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "parallel/exact/list_kernel.hpp"
#include "parallel/exact/list_row.hpp"
#include "parallel/exact/prediction_kernel.hpp"

namespace carom {

// Cells and disks, each contiguous in memory, that one thread may read and write.
struct ListRegion {
  static constexpr std::uint32_t all_keys = 0xffffffffU;
  std::uint32_t first_key = 0, last_key = all_keys;       // cells [first, last)
  std::uint32_t first_disk = 0, last_disk = 0xffffffffU;  // disks stored in [first, last)
  // The core: disks whose listed position has a coordinate in [core, core + core_size) can be relisted by this thread
  // alone, wherever they are when that is due.
  bool core_is_of_x = false;
  std::uint32_t core = 0, core_size = 0xffffffffU;
  bool holds(std::uint32_t disk) const { return disk >= first_disk && disk < last_disk; }
  bool is_everything() const { return first_disk == 0 && last_disk == 0xffffffffU; }
};

// Stores which disks are in which list; NeighbourLists decides which disks are neighbours.
class ListRows {
 public:
  // Makes rows for this many disks, in blocks of disks that share memory for long lists; only one thread at a time may
  // use a block. Rows keep their contents until they are set anew. There is room for a few more disks.
  void begin(std::size_t disks, std::size_t blocks);
  std::size_t size() const { return rows_.size(); }
  void release() { std::vector<Row>().swap(rows_); }

  // clear_block forgets all lists of a block; enter makes disk i a member of the block, with an empty list.
  void clear_block(std::size_t block);
  void enter(std::uint32_t i, std::size_t block, unsigned sides);
  std::uint32_t block_of(std::uint32_t i) const { return rows_[i].block; }

  static constexpr std::uint32_t row_capacity = row_offsets;
  const ListRow& row(std::uint32_t i) const { return rows_[i]; }
  // Calls visit(offset, count) for the neighbours of disk i that are not in its row: disks i + offset[k]. Offsets
  // beyond count, up to the next multiple of prediction_lanes, are equal to offsets of the list.
  template <class Visit>
  void visit_wide_rows(std::uint32_t i, Visit&& visit) const {
    const Row& row = rows_[i];
    for (std::uint32_t w = row.more; w != none;) {
      const WideRow& wide = wide_[row.block][w];
      visit(static_cast<const std::int32_t*>(wide.offset), wide.count);
      w = wide.next;
    }
  }
  // Calls visit(j) for each neighbour j of disk i.
  template <class Visit>
  void for_each_neighbour(std::uint32_t i, Visit&& visit) const {
    const auto some = [&](const auto* offset, std::uint32_t count) {
      for (std::uint32_t k = 0; k < count; ++k) visit(i + static_cast<std::uint32_t>(std::int32_t{offset[k]}));
    };
    some(rows_[i].offset, rows_[i].count);
    visit_wide_rows(i, some);
  }

  // Are all neighbours of disk i stored in [first, last)? May return false although they are, but never true if they
  // are not.
  bool surely_within(std::uint32_t i, std::uint32_t first, std::uint32_t last) const;
  // Are all of them in the region?
  bool are_within(std::uint32_t i, const ListRegion& region) const {
    if (region.is_everything() || surely_within(i, region.first_disk, region.last_disk)) return true;
    bool within = true;
    for_each_neighbour(i, [&](std::uint32_t j) { within = within && region.holds(j); });
    return within;
  }

  // Between windows: append adds a disk, the last one, with an empty list; drop_last removes the last disk, whose
  // list must be empty and which no other disk may list.
  void append(FixedPointPosition listed_at) {
    rows_.emplace_back();
    rows_.back().listed_at = listed_at;
  }
  void drop_last() { rows_.pop_back(); }

  FixedPointPosition listed_at(std::uint32_t i) const { return rows_[i].listed_at; }
  void set_listed_at(std::uint32_t i, FixedPointPosition p) { rows_[i].listed_at = p; }
  // Bits of ListRow::sides, without has_more.
  void set_sides(std::uint32_t i, unsigned sides) {
    rows_[i].sides = static_cast<std::uint8_t>(sides | (rows_[i].sides & ListRow::has_more));
  }
  [[gnu::always_inline]] void prefetch(std::uint32_t i) const { __builtin_prefetch(rows_.data() + i); }

  // Gives disk i, whose list is empty, these neighbours.
  void set(std::uint32_t i, std::span<const std::uint32_t> near);
  // Gives disk i a new list, which is entirely in the region, and adds disk i to or removes it from the lists of the
  // disks that this concerns. Disks of other regions that list disk i keep it: a neighbour too many does no harm.
  [[gnu::hot]] void replace(std::uint32_t i, std::span<const std::uint32_t> near, const ListRegion& region);

 private:
  using Row = ListRow;
  static constexpr std::uint32_t none = Row::none;
  static_assert(row_padding == prediction_lanes);
  // Neighbours that do not fit in the row.
  static constexpr std::uint32_t wide_row_capacity = 12;
  struct alignas(64) WideRow {
    std::int32_t offset[wide_row_capacity] = {};
    std::uint32_t count = 0;
    std::uint32_t next = none;
  };

  void insert(std::uint32_t i, std::uint32_t j);
  void insert_wide(Row& row, std::int32_t offset);
  void free_wide_rows(std::uint32_t i);
  void exchange(std::uint32_t i, std::span<const std::uint32_t> near, const ListRegion& region);
  [[gnu::hot]] void patch(std::uint32_t i, std::span<const std::uint32_t> near, const ListRegion& region);
  void remove(std::uint32_t i, std::uint32_t j);
  void remove_wide(Row& row, std::int32_t offset);

  ChangeKernel change_kernel_ = choose_change_kernel();
  EditKernels edit_kernels_ = choose_edit_kernels();
  std::vector<Row> rows_;
  std::vector<std::vector<WideRow>> wide_;  // of each block
  std::vector<std::uint32_t> free_wide_;    // of each block: the first of its unused wide rows
};

}  // namespace carom
