// How crowded disks are where they are. Cells and neighbour lists that suit the mean density of the box do not suit a
// pile in a tall box, or a cluster.
#pragma once

#include <cstddef>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// The number density around a disk, averaged over the disks and divided by that of the box: 1 for a gas that fills the
// box, h / 2 l for an atmosphere of scale height l in a box of height h. Below 1.5 the result is 1, so that
// fluctuations of a gas do not count. At most 16384 disks are looked at. disks_of_box: how many there are in the box
// where `disks` are but some of them; 0: they are all.
double crowding(const Disks& disks, const Domain& box, std::size_t disks_of_box = 0);

}  // namespace carom
