#include "core/base/blocking_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace carom {

namespace {

constexpr std::size_t least_blocks = 32;

struct Block {
  double mean, weight;
};

double error_of_independent(const std::vector<Block>& blocks) {
  const auto n = static_cast<double>(blocks.size());
  double sum = 0.0, weight = 0.0, squares = 0.0;
  for (const Block& b : blocks) {
    sum += b.weight * b.mean;
    weight += b.weight;
  }
  for (const Block& b : blocks) {
    const double part = b.weight * (b.mean - sum / weight);
    squares += part * part;
  }
  return std::sqrt(squares / (n - 1.0) * n) / weight;
}

Block together(const Block& a, const Block& b) {
  const double weight = a.weight + b.weight;
  return {(a.weight * a.mean + b.weight * b.mean) / weight, weight};
}

}  // namespace

double blocking_error(const std::vector<double>& series, const std::vector<double>& weights) {
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const double weight = weights.empty() ? 1.0 : weights[k];
    if (!std::isnan(series[k]) && weight > 0.0) blocks.push_back({series[k], weight});
  }
  if (blocks.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  double largest = error_of_independent(blocks);
  while (blocks.size() >= 2 * least_blocks) {
    for (std::size_t k = 0; k < blocks.size() / 2; ++k) blocks[k] = together(blocks[2 * k], blocks[2 * k + 1]);
    blocks.resize(blocks.size() / 2);
    largest = std::max(largest, error_of_independent(blocks));
  }
  return largest;
}

}  // namespace carom
