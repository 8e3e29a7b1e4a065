// Two numbers of each disk at one moment, by id: what later moments are compared with.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/disks/disks_in_pieces.hpp"

namespace carom {

// x, y: vx and vy of all disks, each at the place of its id; NaN where there is no such disk.
inline void keep_by_id(const DisksInPieces& disks, std::vector<double>& x, std::vector<double>& y) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  // Ids begin without gaps: room that need not grow piece by piece.
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
