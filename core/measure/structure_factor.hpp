// The structure factor S(k) along the periodic axes.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// Entry n - 1: |sum of exp(i k x)|^2 / N for k = 2 pi n / period, summed over the samples. Empty along an axis that is
// not periodic, where the walls would contribute. In a sheared box whose images above are displaced by an offset, waves
// with the period of the images have kx = 2 pi n / width and ky = 2 pi (m - n offset / width) / height: along_x takes
// the m with the least |ky|, which is at most pi / height; along_y, with n = 0, does not change.
struct StructureFactor {
  std::vector<double> along_x, along_y;
  Count samples = 0;  // with disks
};

// box: at the time of the disks. Sums run in order of ids: the same bits for any storage order.
void add_structure(StructureFactor& structure, const DisksInPieces& disks, const Domain& box);
inline void add_structure(StructureFactor& structure, const Disks& disks, const Domain& box) {
  add_structure(structure, WholeDisks(disks, 0.0), box);
}

}  // namespace carom
