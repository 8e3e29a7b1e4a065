#include "parallel/slabs/slab_cut.hpp"

#include <algorithm>
#include <numeric>

namespace carom {

double SlabCut::thinnest() const {
  double least = bounds.back() - bounds.front();
  for (int r = 0; r < ranks(); ++r) least = std::min(least, high(r) - low(r));
  return least;
}

int SlabCut::rank_at(double y) const {
  const auto inner = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, y);
  return static_cast<int>(inner - bounds.begin()) - 1;
}

SlabCut cut_into_slabs(const Domain& box, const Disks& disks, int ranks, double least) {
  std::vector<double> y = disks.y;
  std::sort(y.begin(), y.end());
  const auto slabs = static_cast<std::size_t>(ranks);
  SlabCut cut;
  for (std::size_t r = 0; r < slabs; ++r) {
    const double even = box.height * static_cast<double>(r) / static_cast<double>(slabs);
    cut.bounds.push_back(r == 0 ? 0.0 : y.empty() ? even : y[y.size() * r / slabs]);
  }
  cut.bounds.push_back(box.height);
  keep_thick(cut, least);
  return cut;
}

SlabCut cut_by_rows(const Domain& box, const std::vector<std::int64_t>& disks_of_row, int ranks) {
  const double height = box.height / static_cast<double>(disks_of_row.size());
  const auto all = static_cast<double>(std::accumulate(disks_of_row.begin(), disks_of_row.end(), std::int64_t{0}));
  SlabCut cut;
  cut.bounds.push_back(0.0);
  double below = 0.0;
  for (std::size_t row = 0; row < disks_of_row.size(); ++row) {
    const auto here = static_cast<double>(disks_of_row[row]);
    while (static_cast<int>(cut.bounds.size()) < ranks) {
      const double wanted = all * static_cast<double>(cut.bounds.size()) / ranks;
      if (below + here < wanted) break;
      const double share = here > 0.0 ? (wanted - below) / here : 0.0;
      cut.bounds.push_back((static_cast<double>(row) + share) * height);
    }
    below += here;
  }
  cut.bounds.resize(static_cast<std::size_t>(ranks), box.height);
  cut.bounds.push_back(box.height);
  return cut;
}

void keep_thick(SlabCut& cut, double least) {
  const std::size_t slabs = cut.bounds.size() - 1;
  for (std::size_t r = 1; r < slabs; ++r) cut.bounds[r] = std::max(cut.bounds[r], cut.bounds[r - 1] + least);
  for (std::size_t r = slabs - 1; r > 0; --r) cut.bounds[r] = std::min(cut.bounds[r], cut.bounds[r + 1] - least);
}

}  // namespace carom
