// The values of trajectory.h5 for the disk at each place, as bytes of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/measure/displacement.hpp"

namespace carom {

enum class H5mdQuantity : std::uint8_t { position, velocity, id, mass, radius, species, image, spin };

// Places [begin, end) of a file; disk_at has the storage index of the disk at each, or no_disk (disk_selection.hpp),
// and may be shorter than the file.
struct H5mdPlaces {
  const std::vector<std::uint32_t>& disk_at;
  std::size_t begin = 0, end = 0;
};

// The form of the values in a file.
struct H5mdForm {
  bool single = false;                        // positions, velocities and spins in single precision
  int dimensions = 2;                         // of these, and of the image
  std::vector<DiskId> group_ends;             // for the species, see disk_group.hpp
  const DisplacementTally* rounds = nullptr;  // for the image
};

// Writes the quantity at these places to buffer, one after the other (x, y and possibly z in turn), with the fill
// values of h5md_layout.hpp where there is no disk. Throws InputError for a number beyond single precision.
void fill_with_values(H5mdQuantity quantity, const H5mdForm& form, const Disks& disks, const H5mdPlaces& places,
                      std::vector<unsigned char>& buffer);

}  // namespace carom
