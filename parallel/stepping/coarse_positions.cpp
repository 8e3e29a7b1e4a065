#include "parallel/stepping/coarse_positions.hpp"

namespace carom {

namespace {

constexpr std::size_t radius_block = 16384;

}  // namespace

void begin_coarse_positions(const Disks& d, const CellGrid& grid, const SortedCells& cells, const Executor& executor,
                            CoarsePositions& coarse) {
  coarse.position.resize(d.size() + coarse_lanes);
  coarse.current = false;
  coarse.radius.clear();
  if (d.radius.empty()) return;
  coarse.radius.resize(d.size() + coarse_lanes);
  for (const GridLevel& level : grid.levels) {
    const LevelRange range = range_of(level, cells);
    const double per_unit = 1.0 / coarse_unit(level);
    executor.for_ranges(range.last - range.first, radius_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = range.first + begin; i < range.first + end; ++i) {
        coarse.radius[i] = static_cast<std::uint32_t>(d.radius[i] * per_unit) + 1U;
      }
    });
  }
}

}  // namespace carom
