// How crowded disks are where they are: what cells and neighbour lists that suit the mean density of the box do not
// know of a pile in a tall box, or of a cluster.
#pragma once

#include <cstddef>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// The number density around a disk, in the mean over the disks, over that of the box: 1 for a gas that fills the box,
// h / 2 l for an atmosphere of scale height l in a box of height h. At least 1, and exactly that where it would be
// below 1.5, so that a gas is searched as its density asks for, whatever it fluctuates. From 16384 of the
// disks at most. disks_of_box: where these are but some of those in the box; 0: they are all.
double crowding(const Disks& disks, const Domain& box, std::size_t disks_of_box = 0);

}  // namespace carom
