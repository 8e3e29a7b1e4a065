// Disks of other ranks that a rank needs in a step: stored behind its own ones, and removed at the step's end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/disks/disks.hpp"
#include "parallel/slabs/moving_disks.hpp"

namespace carom {

// The borders of a slab, as bits.
enum Border : std::uint8_t { no_border = 0, lower_border = 1, upper_border = 2, both_borders = 3 };

class GhostDisks {
 public:
  // Begins without ghosts; the rank's own disks are those before `own`.
  void begin(std::size_t own) {
    own_ = own;
    places_.clear();
    border_.clear();
  }

  bool is_ghost(std::uint32_t i) const { return i >= own_; }
  std::size_t own() const { return own_; }
  std::size_t count() const { return border_.size(); }

  // Stores those of the disks that are not stored yet, as disks beyond this border.
  void add(const std::vector<Disk>& disks, Border border, DiskColumns columns, Disks& d) {
    const std::size_t known = places_.size();
    for (const Disk& disk : disks) {
      if (find_among(known, disk.id)) continue;
      places_.push_back({disk.id, static_cast<std::uint32_t>(d.size())});
      border_.push_back(border);
      push_back(d, disk, columns);
    }
    std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.id < b.id; });
  }

  // The storage index of the disk, if it is a ghost.
  std::optional<std::uint32_t> find(DiskId id) const { return find_among(places_.size(), id); }

  // The border beyond which the ghost at storage index i was first found.
  Border border_of(std::uint32_t i) const { return border_[i - own_]; }

 private:
  struct Place {
    DiskId id;
    std::uint32_t index;
  };

  // The first `known` places are in order of id.
  std::optional<std::uint32_t> find_among(std::size_t known, DiskId id) const {
    const auto end = places_.begin() + static_cast<std::ptrdiff_t>(known);
    const auto at =
        std::lower_bound(places_.begin(), end, id, [](const Place& p, DiskId wanted) { return p.id < wanted; });
    if (at == end || at->id != id) return {};
    return at->index;
  }

  std::size_t own_ = 0;
  std::vector<Place> places_;
  std::vector<Border> border_;
};

}  // namespace carom
