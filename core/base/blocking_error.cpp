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

struct Scatter {
  double error = 0.0;        // of the mean, where blocks are independent
  double correlation = 0.0;  // of a block with the next one
};

Scatter scatter_of(const std::vector<Block>& blocks) {
  const auto n = static_cast<double>(blocks.size());
  double sum = 0.0, weight = 0.0, squares = 0.0, products = 0.0, before = 0.0;
  for (const Block& b : blocks) {
    sum += b.weight * b.mean;
    weight += b.weight;
  }
  for (const Block& b : blocks) {
    const double part = b.weight * (b.mean - sum / weight);
    squares += part * part;
    products += part * before;
    before = part;
  }
  return {std::sqrt(squares / (n - 1.0) * n) / weight, squares > 0.0 ? products / squares : 0.0};
}

// The error where blocks are correlated: it is taken that a share c of a block's deviation is left in the next block,
// c^2 in the one after it, and so on. A c as small as independent blocks have by chance counts as 0.
double error_of_correlated(const Scatter& scatter, std::size_t blocks) {
  const double c = scatter.correlation;
  if (!(c > 1.0 / std::sqrt(static_cast<double>(blocks)))) return scatter.error;
  return scatter.error * std::sqrt((1.0 + c) / (1.0 - c));
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
  Scatter scatter = scatter_of(blocks);
  double largest = scatter.error;
  while (blocks.size() >= 2 * least_blocks) {
    for (std::size_t k = 0; k < blocks.size() / 2; ++k) blocks[k] = together(blocks[2 * k], blocks[2 * k + 1]);
    blocks.resize(blocks.size() / 2);
    scatter = scatter_of(blocks);
    largest = std::max(largest, scatter.error);
  }
  return std::max(largest, error_of_correlated(scatter, blocks.size()));
}

}  // namespace carom
