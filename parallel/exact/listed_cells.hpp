// The cells that listed positions are in.
#pragma once

#include <algorithm>
#include <cstdint>

#include "parallel/cells/nearby_runs.hpp"

namespace carom {

// Which of so many cells along a side holds the disks that are listed at a coordinate. at: in 2^-32 of a period, or in
// 2^-31 of a side between walls.
inline std::uint32_t cell_of_listed(std::uint32_t at, std::uint32_t cells, bool periodic) {
  const auto k = static_cast<std::uint32_t>(std::uint64_t{at} * cells >> (periodic ? 32U : 31U));
  return std::min(k, cells - 1);  // the far wall itself
}

// The cells of the disks that are listed within reach of a coordinate.
inline Span span_around_listed(std::uint32_t at, std::uint32_t reach, std::uint32_t cells, bool periodic) {
  // Where the two ends come within a cell of each other along the period, the whole side is taken once.
  if (cells <= 2 || 2 * std::uint64_t{reach} * cells >= std::uint64_t{cells - 2} << (periodic ? 32U : 31U))
    return {0, cells};
  const std::uint32_t low = periodic || at > reach ? at - reach : 0;
  const std::uint32_t first = cell_of_listed(low, cells, periodic);
  const std::uint32_t last = cell_of_listed(at + reach, cells, periodic);
  return {first, last >= first ? last - first + 1 : cells - first + last + 1};
}

}  // namespace carom
