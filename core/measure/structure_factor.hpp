// The structure factor S(k) along the periodic axes.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// Entry n - 1: |sum of exp(i k x)|^2 / N for k = 2 pi n / period, summed over the samples. Empty along an axis that is
// not periodic, where the walls would be part of it.
struct StructureFactor {
  std::vector<double> along_x, along_y;
  Count samples = 0;  // with disks
};

// In order of ids: the same bits in any storage order.
void add_structure(StructureFactor& structure, const Disks& disks, const Domain& box);

}  // namespace carom
