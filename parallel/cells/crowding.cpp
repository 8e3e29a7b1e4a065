#include "parallel/cells/crowding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/disks/cell_index.hpp"

namespace carom {

namespace {

constexpr std::size_t most_samples = 16384;
// Samples in a cell at first, if they were spread evenly over the box.
constexpr double spread_samples = 16.0;
// Cells are made smaller until a sample shares its cell with no more than this number of others on average: then cells
// are smaller than dense regions.
constexpr double most_samples_a_cell = 40.0;
constexpr double refinement = 4.0;
constexpr double most_cells = 0x1p50;
constexpr double most_cells_of_side = 0x1p31;
// Below this, the result is 1.
constexpr double least_crowding = 1.5;

// The number of samples in the cell of a sample, averaged over the samples. key: the cell of each; gets sorted.
double mean_occupancy(std::vector<std::uint64_t>& key, double cells) {
  double squares = 0.0;
  const auto add = [&](double samples) { squares += samples * samples; };
  if (cells <= static_cast<double>(key.size())) {
    std::vector<std::uint32_t> count(static_cast<std::size_t>(cells));
    for (const std::uint64_t cell : key) ++count[cell];
    for (const std::uint32_t samples : count) add(samples);
  } else {
    std::sort(key.begin(), key.end());
    for (auto first = key.begin(); first != key.end();) {
      const auto last = std::find_if(first, key.end(), [&](std::uint64_t cell) { return cell != *first; });
      add(static_cast<double>(last - first));
      first = last;
    }
  }
  return squares / static_cast<double>(key.size());
}

}  // namespace

double crowding(const Disks& d, const Domain& box, std::size_t disks_of_box) {
  if (d.size() < 2) return 1.0;
  const std::size_t step = d.size() / most_samples + 1;
  const double samples_of_box = static_cast<double>(std::max(d.size(), disks_of_box)) / static_cast<double>(step);
  std::vector<std::uint64_t> key((d.size() + step - 1) / step);
  for (double wanted = samples_of_box / spread_samples;; wanted *= refinement) {
    // Nearly square cells, as far as their number allows.
    const double most_columns = std::clamp(wanted, 1.0, most_cells_of_side);
    const double columns = std::floor(std::clamp(std::sqrt(wanted * box.width / box.height), 1.0, most_columns));
    const double rows = std::floor(std::clamp(wanted / columns, 1.0, most_cells_of_side));
    const auto columns_of_row = static_cast<std::uint64_t>(columns);
    for (std::size_t k = 0; k < key.size(); ++k) {
      key[k] = cell_index(d.y[k * step] * (rows / box.height), static_cast<std::uint64_t>(rows)) * columns_of_row +
               cell_index(d.x[k * step] * (columns / box.width), columns_of_row);
    }
    // A disk does not crowd itself.
    const double others = mean_occupancy(key, columns * rows) - 1.0;
    if (others > most_samples_a_cell && wanted < most_cells) continue;
    const double measured = others * columns * rows / samples_of_box;
    return measured < least_crowding ? 1.0 : measured;
  }
}

}  // namespace carom
