// What trajectory.h5 says of the disk at each place, as the bytes that go into the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks.hpp"

namespace carom {

enum class H5mdQuantity : std::uint8_t { position, velocity, id, mass, radius, species };

// Places [begin, end) of a file; disk_at has the storage index of the disk at each, or no_disk (disk_selection.hpp),
// and may be shorter than the file.
struct H5mdPlaces {
  const std::vector<std::uint32_t>& disk_at;
  std::size_t begin = 0, end = 0;
};

// Writes the quantity of these places to buffer, one after the other (x and y in turn), the fill values of
// h5md_layout.hpp where there is no disk. single: position and velocity in single precision. group_ends: the id after
// the last of each group of the scene, for the species.
void fill_with_values(H5mdQuantity quantity, bool single, const Disks& disks, const std::vector<DiskId>& group_ends,
                      const H5mdPlaces& places, std::vector<unsigned char>& buffer);

}  // namespace carom
