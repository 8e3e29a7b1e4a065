// Which disks lie in which cell, by their listed positions: a few slots for each cell, so that disks can come and go,
// and cells can be searched, without following links.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "parallel/exact/list_kernel.hpp"

namespace carom {

// A disk whose cell has no slot left is chained to the cell.
class CellSlots {
 public:
  static constexpr std::uint32_t none = empty_slot;

  // Empties all cells. cells_a_part successive cells are a part, which is for one thread at a time. unequal_radii:
  // slots hold radii too.
  void begin(std::uint32_t cells, std::uint32_t cells_a_part, bool unequal_radii);

  // radius: in the kernel's unit of length, rounded up a little (NeighbourLists::radius_in_units); ignored where all
  // are equal.
  [[gnu::hot]] void insert(std::uint32_t cell, std::uint32_t disk, SlotPosition position, float radius);
  // Takes the disk out of the cell that it is in.
  [[gnu::hot]] void remove(std::uint32_t cell, std::uint32_t disk);

  SlotColumns columns() const { return {position_.data(), disk_.data(), radius_.empty() ? nullptr : radius_.data()}; }
  // As begin() was told.
  bool have_radii() const { return !radius_.empty(); }
  // Prefetches cells [first, last).
  [[gnu::always_inline]] void prefetch(std::uint32_t first, std::uint32_t last) const {
    prefetch_slots(position_.data(), first, last);
    prefetch_slots(disk_.data(), first, last);
    __builtin_prefetch(chain_.data() + first);
  }
  // Asks whether disks are chained to some of the cells of several runs.
  class Chains {
   public:
    // Adds cells [first, last); perhaps some after them, too.
    void add(std::uint32_t first, std::uint32_t last) {
      constexpr std::uint32_t at_once = 4;
      if (first + at_once > end_) [[unlikely]] {
        for (; first < last; ++first) all_ &= Links{chain_[first], none, none, none};
        return;
      }
      all_ &= four(first);
      for (first += at_once; first < last; first += at_once) all_ &= four(std::min(first, last - at_once));
    }
    // Are disks chained to any of them? The number of a link is below 2^31, or all ones for none.
    bool any() const { return (all_[0] & all_[1] & all_[2] & all_[3]) != none; }

   private:
    friend class CellSlots;
    using Links = std::uint32_t __attribute__((vector_size(16)));
    Chains(const std::uint32_t* chain, std::uint32_t end) : chain_(chain), end_(end) {}
    Links four(std::uint32_t cell) const {
      Links links;
      std::memcpy(&links, chain_ + cell, sizeof links);
      return links;
    }
    const std::uint32_t* chain_;
    std::uint32_t end_;
    Links all_ = {none, none, none, none};
  };
  // For cells before `end`; nothing is read from there on.
  Chains chains_before(std::uint32_t end) const {
    return {chain_.data(), std::min(end, static_cast<std::uint32_t>(chain_.size()))};
  }
  // Calls visit(disk) for the disks chained to cells [first, last). Reads nothing of cells from `end` on.
  template <class Visit>
  void visit_chained(std::uint32_t first, std::uint32_t last, std::uint32_t end, Visit&& visit) const {
    constexpr std::uint32_t at_once = 4;
    while (first < last) {
      const std::uint32_t* const c = &chain_[first];
      if (first + at_once <= end && first + at_once <= chain_.size() && (c[0] & c[1] & c[2] & c[3]) == none)
          [[likely]] {
        first += at_once;
        continue;
      }
      for (std::uint32_t m = *c; m != none;) {
        const Link link = links_of(first).link[m];
        visit(link.disk);
        m = link.next;
      }
      ++first;
    }
  }

 private:
  struct Link {
    std::uint32_t disk;
    std::uint32_t next;  // number of a link of the same part; none
  };
  struct PartLinks {
    std::vector<Link> link;
    std::uint32_t free = none;  // the first of those that are not in use
  };
  // Of a column by slot, whose entries have 4 bytes.
  template <class T>
  [[gnu::always_inline]] static void prefetch_slots(const T* column, std::uint32_t first, std::uint32_t last) {
    static_assert(sizeof(T) == 4);
    constexpr std::size_t a_line = 16;
    const std::size_t end = std::size_t{last} * slots_a_cell;
    for (std::size_t s = std::size_t{first} * slots_a_cell; s < end; s += a_line) __builtin_prefetch(column + s);
    __builtin_prefetch(column + (end - 1));
  }
  const PartLinks& links_of(std::uint32_t cell) const { return links_[cell / cells_a_part_]; }
  PartLinks& links_of(std::uint32_t cell) { return links_[cell / cells_a_part_]; }

  // By slot.
  std::vector<SlotPosition> position_;
  std::vector<std::uint32_t> disk_;   // none: empty
  std::vector<float> radius_;         // where they differ
  std::vector<std::uint32_t> chain_;  // by cell: number of the link of the first disk chained to it
  std::vector<PartLinks> links_;      // by part
  std::uint32_t cells_a_part_ = 1;
};

}  // namespace carom
