#include "core/base/blocking_error.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace carom {

namespace {

constexpr std::size_t least_blocks = 32;

double error_of_independent(const std::vector<double>& blocks) {
  const auto n = static_cast<double>(blocks.size());
  double mean = 0.0, squares = 0.0;
  for (const double x : blocks) mean += x / n;
  for (const double x : blocks) squares += (x - mean) * (x - mean);
  return std::sqrt(squares / n / (n - 1.0));
}

}  // namespace

double blocking_error(const std::vector<double>& series) {
  std::vector<double> blocks;
  std::copy_if(series.begin(), series.end(), std::back_inserter(blocks), [](double x) { return !std::isnan(x); });
  if (blocks.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  double largest = error_of_independent(blocks);
  while (blocks.size() >= 2 * least_blocks) {
    for (std::size_t k = 0; k < blocks.size() / 2; ++k) blocks[k] = 0.5 * (blocks[2 * k] + blocks[2 * k + 1]);
    blocks.resize(blocks.size() / 2);
    largest = std::max(largest, error_of_independent(blocks));
  }
  return largest;
}

}  // namespace carom
