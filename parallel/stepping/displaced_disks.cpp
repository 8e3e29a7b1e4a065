#include "parallel/stepping/displaced_disks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/step/step_rounds.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

namespace {

// Disks in a block, both of the passes over all disks and of the search around displaced ones.
constexpr std::size_t disk_block = 8192;
constexpr std::size_t search_block = 64;

template <class View>
double find_displaced_in(const View& d, std::size_t n, const Domain& box, const Executor& executor,
                         DisplacedDisks& displaced) {
  const std::size_t blocks = executor.blocks(n, disk_block);
  while (displaced.blocks.size() < blocks) {
    displaced.blocks.emplace_back();
    displaced.blocks.back().reserve(search_block);
  }
  assign_amply(displaced.furthest2, blocks, 0.0);
  executor.for_ranges(n, disk_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    displaced.blocks[b].clear();
    double furthest2 = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      if (d.x[i] == displaced.x[i] && d.y[i] == displaced.y[i]) continue;
      if (is_displaced(d, box, i, displaced.x[i], displaced.y[i])) {
        displaced.blocks[b].push_back(static_cast<std::uint32_t>(i));
      }
      furthest2 = std::max(furthest2, displacement2(d, box, i, displaced.x[i], displaced.y[i]));
    }
    displaced.furthest2[b] = furthest2;
  });
  displaced.all.clear();
  double furthest2 = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    displaced.all.insert(displaced.all.end(), displaced.blocks[b].begin(), displaced.blocks[b].end());
    furthest2 = std::max(furthest2, displaced.furthest2[b]);
  }
  return std::sqrt(furthest2);
}

template <class View>
bool is_pressed_in(const View& d, const Domain& box, const CellList& cells, double slack, std::size_t i) {
  if (is_pressed_into_wall(d, box, i)) return true;
  bool pressed = false;
  for (const GridLevel& level : cells.grid.levels) {
    const double reach = d.radius(i) + level.largest_radius + level.margin + slack;
    for_each_run_near(level, cells.sorted.start.data(), box, d.x[i], d.y[i], reach,
                      [&](std::uint32_t first, std::uint32_t last) {
                        for (std::uint32_t j = first; j < last; ++j) {
                          pressed = pressed || (j != i && are_pressed(d, box, i, j));
                        }
                      });
  }
  return pressed;
}

}  // namespace

void keep_places(const Disks& disks, const Executor& executor, DisplacedDisks& displaced) {
  const std::size_t n = disks.size();
  resize_amply(displaced.x, n);
  resize_amply(displaced.y, n);
  executor.for_ranges(n, disk_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::copy(disks.x.data() + begin, disks.x.data() + end, displaced.x.data() + begin);
    std::copy(disks.y.data() + begin, disks.y.data() + end, displaced.y.data() + begin);
  });
}

double find_displaced(Disks& disks, const Domain& box, const Executor& executor, DisplacedDisks& displaced) {
  return with_view(disks, [&](const auto& d) { return find_displaced_in(d, disks.size(), box, executor, displaced); });
}

bool is_pressed(Disks& disks, const Domain& box, const CellList& cells, double slack, std::size_t i) {
  return with_view(disks, [&](const auto& d) { return is_pressed_in(d, box, cells, slack, i); });
}

bool any_pressed(Disks& disks, const Domain& box, const CellList& cells, double slack, const Executor& executor,
                 DisplacedDisks& displaced) {
  return with_view(disks, [&](const auto& d) {
    const std::vector<std::uint32_t>& all = displaced.all;
    assign_amply(displaced.pressed, executor.blocks(all.size(), search_block), static_cast<unsigned char>(0));
    executor.for_ranges(all.size(), search_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end && displaced.pressed[b] == 0; ++k) {
        displaced.pressed[b] = is_pressed_in(d, box, cells, slack, all[k]) ? 1 : 0;
      }
    });
    return std::find(displaced.pressed.begin(), displaced.pressed.end(), 1) != displaced.pressed.end();
  });
}

bool presses_others(Disks& disks, const Domain& box, const CellList& cells, double strayed, const Executor& executor,
                    DisplacedDisks& displaced) {
  const double slack = strayed + find_displaced(disks, box, executor, displaced);
  return any_pressed(disks, box, cells, slack, executor, displaced);
}

}  // namespace carom
