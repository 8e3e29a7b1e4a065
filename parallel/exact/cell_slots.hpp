// Which disks lie in which cell, by their listed positions: a few slots for each cell, so that disks come and go and
// cells are searched without following links.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "parallel/exact/list_kernel.hpp"

namespace carom {

// A disk for which its cell has no slot left is chained to the cell.
class CellSlots {
 public:
  static constexpr std::uint32_t none = empty_slot;

  // Empties all cells, for this many disks. unequal_radii: slots hold radii too.
  void begin(std::uint32_t cells, std::size_t disks, bool unequal_radii);

  // radius: over the unit of lengths that the kernel works in, a little more; ignored where all are equal.
  void insert(std::uint32_t cell, std::uint32_t disk, FixedPointPosition position, float radius);
  std::uint32_t cell_of(std::uint32_t disk) const { return cell_[disk]; }
  // Takes the disk out of its cell. False, without a change, if it is chained behind a disk that holds(disk) denies:
  // another thread may read that one's link.
  template <class Holds>
  bool remove(std::uint32_t disk, Holds&& holds) {
    const std::uint32_t first = cell_[disk] * slots_a_cell;
    for (std::uint32_t s = first; s < first + slots_a_cell; ++s) {
      if (disk_[s] != disk) continue;
      disk_[s] = none;
      return true;
    }
    return unchain(disk, holds);
  }

  // Between windows: one more disk, the last, in no cell yet; and one less, which is in none.
  void append() {
    cell_.push_back(none);
    next_.push_back(none);
  }
  void drop_last() {
    cell_.pop_back();
    next_.pop_back();
  }

  SlotColumns columns() const { return {position_.data(), disk_.data(), radius_.empty() ? nullptr : radius_.data()}; }
  // Calls visit(disk) for the disks chained to cells [first, last). Reads nothing of cells from `end` on.
  template <class Visit>
  void visit_chained(std::uint32_t first, std::uint32_t last, std::uint32_t end, Visit&& visit) const {
    constexpr std::uint32_t at_once = 4;
    // A link is a disk's number, below 2^31, or all ones.
    while (first < last) {
      const std::uint32_t* const c = &chain_[first];
      if (first + at_once <= end && first + at_once <= chain_.size() && (c[0] & c[1] & c[2] & c[3]) == none)
          [[likely]] {
        first += at_once;
        continue;
      }
      for (std::uint32_t m = *c; m != none; m = next_[m]) visit(m);
      ++first;
    }
  }

 private:
  template <class Holds>
  bool unchain(std::uint32_t disk, Holds&& holds) {
    std::uint32_t* link = &chain_[cell_[disk]];
    bool may_write = true;
    while (*link != disk) {
      may_write = holds(*link);
      link = &next_[*link];
    }
    if (may_write) *link = next_[disk];
    return may_write;
  }

  // By slot.
  std::vector<FixedPointPosition> position_;
  std::vector<std::uint32_t> disk_;   // none: empty
  std::vector<float> radius_;         // where they differ
  std::vector<std::uint32_t> chain_;  // by cell: the first disk chained to it
  // By disk.
  std::vector<std::uint32_t> cell_;
  std::vector<std::uint32_t> next_;  // where it is chained
};

}  // namespace carom
