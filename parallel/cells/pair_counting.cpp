#include "parallel/cells/pair_counting.hpp"

#include <memory>

#include "parallel/threads/executor.hpp"

namespace carom {

namespace {

// Rows a block where there are many: each block has counts of its own, which are added up at the end.
std::size_t rows_a_block(std::size_t rows) {
  constexpr std::size_t most_blocks = 256;
  return (rows + most_blocks - 1) / most_blocks;
}

PairCounts count_in_blocks(const Disks& disks, const Domain& box, const DistanceBins& bins, const Executor& executor) {
  const DistanceCells cells(disks, box, bins);
  const std::size_t block = rows_a_block(cells.rows());
  std::vector<std::vector<Count>> parts(executor.blocks(cells.rows(), block));
  executor.for_ranges(cells.rows(), block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    parts[b].assign(bins.bins, 0);
    cells.count(begin, end, parts[b]);
  });
  PairCounts result{cells.centres(), std::vector<Count>(bins.bins, 0)};
  for (const std::vector<Count>& part : parts) {
    for (std::size_t k = 0; k < part.size(); ++k) result.counts[k] += part[k];
  }
  return result;
}

}  // namespace

PairCounter parallel_pair_counter(int threads) {
  const auto executor = std::make_shared<const Executor>(threads);
  return [executor](const Disks& disks, const Domain& box, const DistanceBins& bins) {
    return count_in_blocks(disks, box, bins, *executor);
  };
}

}  // namespace carom
