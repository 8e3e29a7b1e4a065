// Two numbers of each disk at one moment, by id, for comparison with later moments.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/disks/disks_in_pieces.hpp"

namespace carom {

// Stores vx and vy of all disks in x and y by id; NaN for ids without a disk.
inline void keep_by_id(const DisksInPieces& disks, std::vector<double>& x, std::vector<double>& y) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  // Initial ids have no gaps, so this is usually enough.
  x.reserve(disks.size());
  y.reserve(disks.size());
  disks.visit([&](const Disks& d) {
    if (d.empty()) return;
    const std::size_t ids = *std::max_element(d.id.begin(), d.id.end()) + std::size_t{1};
    x.resize(ids, none);
    y.resize(ids, none);
    for (std::size_t i = 0; i < d.size(); ++i) {
      x[d.id[i]] = d.vx[i];
      y[d.id[i]] = d.vy[i];
    }
  });
}

}  // namespace carom
