// The densest packing of equal disks.
#pragma once

namespace carom {

// The packing fraction of the hexagonal lattice, pi / sqrt(12). It bounds equal disks between walls, too; disks of
// several sizes may be denser, as small ones fill gaps.
inline constexpr double densest_packing = 0.90689968211710892530;

}  // namespace carom
