#include "parallel/stepping/coarse_positions.hpp"

namespace carom {

namespace {

// Disks a block of the passes over all.
constexpr std::size_t pass_block = 16384;

// Each disk's radius in units of its level.
void note_radii(const Disks& d, const Executor& executor, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  coarse.radius.resize(d.size() + coarse_lanes);
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

bool is_crowded(const SortedCells& cells, const GridLevel& level, std::uint32_t i) {
  const NearRuns runs = near_runs(cells.start.data(), cells.key[i], level.stride, i);
  return runs.own_end > runs.own + coarse_lanes || runs.above_end > runs.above + coarse_lanes;
}

void note_crowded(const Executor& executor, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  coarse.crowded.clear();
  for (const GridLevel& level : cells.grid.levels) {
    const LevelRange range = range_of(level, cells.sorted);
    const std::size_t n = range.last - range.first;
    const std::size_t blocks = executor.blocks(n, pass_block);
    if (coarse.crowded_blocks.size() < blocks) coarse.crowded_blocks.resize(blocks);
    executor.for_ranges(n, pass_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t>& crowded = coarse.crowded_blocks[b];
      crowded.clear();
      for (std::size_t k = range.first + begin; k < range.first + end; ++k) {
        const auto i = static_cast<std::uint32_t>(k);
        if (is_crowded(cells.sorted, level, i)) crowded.push_back(i);
      }
    });
    for (std::size_t b = 0; b < blocks; ++b) {
      coarse.crowded.insert(coarse.crowded.end(), coarse.crowded_blocks[b].begin(), coarse.crowded_blocks[b].end());
    }
  }
}

}  // namespace

void begin_coarse_positions(const Disks& d, const Executor& executor, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  coarse.position.resize(d.size() + coarse_lanes);
  coarse.current = false;
  coarse.loose.clear();
  coarse.radius.clear();
  if (!d.radius.empty()) note_radii(d, executor, cells);
  note_crowded(executor, cells);
}

}  // namespace carom
