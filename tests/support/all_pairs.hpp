// A search for pairs without a grid, O(N^2), with which searches through cells are compared.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/pair.hpp"
#include "core/physics/disk_pair.hpp"

namespace carom::test {

// The result of find_touching_pairs (core/reference/pair_search.hpp), in the same order.
inline std::vector<Pair> touching_among_all_pairs(const Disks& d, const Domain& box) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    for (std::uint32_t j = i + 1; j < d.size(); ++j) {
      const double distance2 = nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box);
      if (!touches(distance2, d.radius_of(i) + d.radius_of(j))) continue;
      pairs.push_back(d.id[i] < d.id[j] ? Pair{i, j} : Pair{j, i});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
    return std::pair(d.id[a.i1], d.id[a.i2]) < std::pair(d.id[b.i1], d.id[b.i2]);
  });
  return pairs;
}

}  // namespace carom::test
