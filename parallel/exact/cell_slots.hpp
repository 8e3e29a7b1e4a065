// The disks of each cell, by their listed positions: a few slots for each cell, so that disks can be inserted, removed
// and searched without following links.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "parallel/exact/list_kernel.hpp"

namespace carom {

// A disk whose cell has no slot left is chained to the cell.
class CellSlots {
 public:
  static constexpr std::uint32_t none = empty_slot;

  // Empties all cells. cells_a_part successive cells form a part, which only one thread at a time may change.
  // unequal_radii: slots hold radii, too.
  void begin(std::uint32_t cells, std::uint32_t cells_a_part, bool unequal_radii);

  // radius: in the kernel's unit of length, rounded up a little (NeighbourLists::radius_in_units); ignored if all are
  // equal.
  [[gnu::hot]] void insert(std::uint32_t cell, std::uint32_t disk, SlotPosition position, float radius);
  // Removes the disk from its cell.
  [[gnu::hot]] void remove(std::uint32_t cell, std::uint32_t disk);

  SlotColumns columns() const { return {cells_.data(), radius_.empty() ? nullptr : radius_.data()}; }
  // As set by begin().
  bool have_radii() const { return !radius_.empty(); }
  // Prefetches cells [first, last).
  [[gnu::always_inline]] void prefetch(std::uint32_t first, std::uint32_t last) const {
    const SlotCell* const cells = cells_.data();
    for (std::uint32_t cell = first; cell < last; ++cell) __builtin_prefetch(cells + cell);
    __builtin_prefetch(chain_.data() + first);
  }
  // May disks be chained to some of the cells of a block? Reads nothing of cells from `end` on.
  [[gnu::always_inline]] bool may_be_chained(const CellBlock& block, std::uint32_t end) const {
    const std::uint32_t* const chain = chain_.data();
    end = std::min(end, static_cast<std::uint32_t>(chain_.size()));
    Links all = no_links;
    std::uint32_t first = block.first;
    for (std::uint32_t left = block.rows; left > 0; --left, first += block.stride) {
      if (first + links_at_once > end) [[unlikely]]
        return true;
      all &= links_from(chain + first);
      for (std::uint32_t k = links_at_once; k < block.width; k += links_at_once)
        all &= links_from(chain + first + std::min(k, block.width - links_at_once));
    }
    // The number of a link is below 2^31, or all ones for none.
    return (all[0] & all[1] & all[2] & all[3]) != none;
  }
  // Calls visit(disk) for the disks in slots of cells [first, last).
  template <class Visit>
  void visit_slots(std::uint32_t first, std::uint32_t last, Visit&& visit) const {
    for (; first < last; ++first) {
      for (const std::uint32_t disk : cells_[first].disk) {
        if (disk != none) visit(disk);
      }
    }
  }
  // Calls visit(disk) for the disks chained to cells [first, last). Reads nothing of cells from `end` on.
  template <class Visit>
  void visit_chained(std::uint32_t first, std::uint32_t last, std::uint32_t end, Visit&& visit) const {
    while (first < last) {
      const std::uint32_t* const c = &chain_[first];
      if (first + links_at_once <= end && first + links_at_once <= chain_.size() && (c[0] & c[1] & c[2] & c[3]) == none)
          [[likely]] {
        first += links_at_once;
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
    std::uint32_t next;  // number of a link of the same part, or none
  };
  struct PartLinks {
    std::vector<Link> link;
    std::uint32_t free = none;  // the first unused link
  };
  // The number of cells whose links are tested at a time.
  static constexpr std::uint32_t links_at_once = 4;
  using Links = std::uint32_t __attribute__((vector_size(4 * links_at_once)));
  static constexpr Links no_links = {none, none, none, none};
  static Links links_from(const std::uint32_t* chain) {
    Links links;
    std::memcpy(&links, chain, sizeof links);
    return links;
  }
  const PartLinks& links_of(std::uint32_t cell) const { return links_[cell / cells_a_part_]; }
  PartLinks& links_of(std::uint32_t cell) { return links_[cell / cells_a_part_]; }

  std::vector<SlotCell> cells_;
  std::vector<float> radius_;         // by slot, if radii differ
  std::vector<std::uint32_t> chain_;  // by cell: number of the link of the first disk chained to it
  std::vector<PartLinks> links_;      // by part
  std::uint32_t cells_a_part_ = 1;
};

}  // namespace carom
