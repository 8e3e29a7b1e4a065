// The disks that a trajectory shows, and their places in it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"

namespace carom {

inline bool is_selected(const Selection& select, const Disks& disks, std::size_t i) {
  const DiskId id = disks.id[i];
  if (!select.by_region) return select.ids.holds(id) && (id - select.ids.first) % select.stride == 0;
  return disks.x[i] >= select.low.x && disks.x[i] <= select.high.x && disks.y[i] >= select.low.y &&
         disks.y[i] <= select.high.y;
}

inline constexpr std::uint32_t no_disk = 0xffffffffU;

// Fills places with the storage index of the disk at each, no_disk if there is none. By stride, the disk k * stride
// (counted from the first of a group) always has place k, and places of disks that are gone stay empty; in a region,
// disks come and go, and take places 0, 1, ... in order of id. least: the least number of places.
void find_places(const Selection& select, const Disks& disks, std::size_t least, std::vector<std::uint32_t>& places);

}  // namespace carom
