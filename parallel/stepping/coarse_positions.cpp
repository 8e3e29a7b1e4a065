#include "parallel/stepping/coarse_positions.hpp"

#include "core/base/huge_pages.hpp"

namespace carom {

namespace {

// Disks in a block of the passes over all disks.
constexpr std::size_t pass_block = 16384;

// Each disk's radius in units of its level.
void note_radii(const Disks& d, const Executor& executor, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  grow_in_huge_pages(coarse.radius, d.size() + coarse_lanes);
  for (const GridLevel& level : cells.grid.levels) {
    const LevelRange range = range_of(level, cells.sorted);
    const double per_unit = 1.0 / coarse_unit(level);
    executor.for_ranges(range.last - range.first, pass_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = range.first + begin; i < range.first + end; ++i) {
        coarse.radius[i] = static_cast<std::uint32_t>(d.radius[i] * per_unit) + 1U;
      }
    });
  }
}

bool has_long_run(const SortedCells& cells, const GridLevel& level, std::uint32_t i) {
  const NearRuns runs = near_runs(cells.start.data(), cells.key[i], level.stride, i);
  return runs.own_end > runs.own + coarse_lanes || runs.above_end > runs.above + coarse_lanes;
}

void find_long_runs(const Executor& executor, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  coarse.long_runs.clear();
  for (const GridLevel& level : cells.grid.levels) {
    const LevelRange range = range_of(level, cells.sorted);
    const std::size_t n = range.last - range.first;
    const std::size_t blocks = executor.blocks(n, pass_block);
    if (coarse.long_runs_of_block.size() < blocks) coarse.long_runs_of_block.resize(blocks);
    executor.for_ranges(n, pass_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t>& long_runs = coarse.long_runs_of_block[b];
      long_runs.clear();
      for (std::size_t k = range.first + begin; k < range.first + end; ++k) {
        const auto i = static_cast<std::uint32_t>(k);
        if (has_long_run(cells.sorted, level, i)) long_runs.push_back(i);
      }
    });
    for (std::size_t b = 0; b < blocks; ++b) {
      coarse.long_runs.insert(coarse.long_runs.end(), coarse.long_runs_of_block[b].begin(),
                              coarse.long_runs_of_block[b].end());
    }
  }
}

}  // namespace

void begin_coarse_positions(const Disks& d, const Executor& executor, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  grow_in_huge_pages(coarse.position, d.size() + coarse_lanes);
  coarse.current = false;
  coarse.loose.clear();
  coarse.radius.clear();
  if (!d.radius.empty()) note_radii(d, executor, cells);
  find_long_runs(executor, cells);
}

}  // namespace carom
