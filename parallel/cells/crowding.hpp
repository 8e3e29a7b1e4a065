// The local density around disks, relative to that of the box. Cells and neighbour lists for the mean density of the
// box do not suit a pile in a tall box, or a cluster.
#pragma once

#include <cstddef>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// The number density around a disk, averaged over the disks and divided by that of the box: 1 for a gas that fills the
// box, h / 2 l for an atmosphere of scale height l in a box of height h. A value below 1.5 is returned as 1, so that
// fluctuations of a gas do not count. Uses a sample of at most 16384 disks. disks_of_box: the number of disks in the
// box if `disks` are only some of them; 0: they are all.
double crowding(const Disks& disks, const Domain& box, std::size_t disks_of_box = 0);

}  // namespace carom
