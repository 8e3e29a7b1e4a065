#include "parallel/start/growth_step.hpp"

#include <utility>

#include "core/physics/disk_pair.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/exact/exact_engine.hpp"

namespace carom {

namespace {

constexpr std::size_t disks_of_task = 2048;  // enough that starting a task is nothing beside them

// What a step keeps beside the disks, in their order in storage.
struct StepColumns {
  std::vector<double> before;  // radius
  std::vector<double> lack;    // target - radius
};

// Sorts the disks into cells of their reach, which takes the place of the radius.
CellGrid sort_by_reach(const Executor& executor, Disks& d, const Domain& box, const std::vector<double>& target,
                       SortedCells& cells, StepColumns& columns) {
  const std::size_t n = d.size();
  std::vector<double> radius = d.radius;
  executor.for_ranges(n, disks_of_task, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) d.radius[i] = growth_reach(radius[i], target[d.id[i]]);
  });
  const double largest = largest_radius(d);
  CellGrid grid = make_grid(box, largest, count_classes(d, largest));
  sort_into_cells(d, grid, executor, cells);
  columns.before.resize(n);
  columns.lack.resize(n);
  executor.for_ranges(n, disks_of_task, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      columns.before[i] = radius[cells.order[i]];
      columns.lack[i] = target[d.id[i]] - columns.before[i];
    }
  });
  return grid;
}

// The radius that all gaps around disk i allow; each pair is looked at from both of its ends, so that no
// thread waits for another.
double grown_radius(const Disks& d, const Domain& box, double target, const CellGrid& grid, const SortedCells& cells,
                    const StepColumns& columns, std::size_t i, bool& overlap) {
  const double length = std::max(box.width, box.height);
  const double radius = columns.before[i];
  const double lack = columns.lack[i];
  double after = std::min(target, radius_within_sides(box, d.x[i], d.y[i], radius));
  const RoomAtObstacles room = radius_within_obstacles(box, d.x[i], d.y[i], radius, d.radius[i]);
  after = std::min(after, room.radius);
  overlap = overlap || room.overlap || !within_sides(box, d.x[i], d.y[i], radius);
  const auto look = [&](std::size_t j) {
    const double distance2 = nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box);
    if (!touches(distance2, d.radius[i] + d.radius[j])) return;
    const double contact = radius + columns.before[j];
    overlap = overlap || distance2 < contact * contact;
    if (!(lack > 0.0)) return;
    const double usable = usable_gap(std::sqrt(distance2) - contact, length);
    after = std::min(after, radius_within(radius, lack, columns.lack[j], usable));
  };
  for (const GridLevel& level : grid.levels) {
    const double reach = d.radius[i] + level.largest_radius + level.margin;
    for_each_run_near(level, cells.start.data(), box, d.x[i], d.y[i], reach,
                      [&](std::uint32_t first, std::uint32_t last) {
                        for (std::uint32_t j = first; j < last; ++j) {
                          if (j != i) look(j);
                        }
                      });
  }
  return after;
}

}  // namespace

GrowthTally parallel_grow_step(const Executor& executor, Disks& d, const Domain& box,
                               const std::vector<double>& target) {
  SortedCells cells;
  StepColumns columns;
  const CellGrid grid = sort_by_reach(executor, d, box, target, cells, columns);
  std::vector<double> after(d.size());
  std::vector<GrowthTally> tally(std::max<std::size_t>(executor.blocks(d.size(), disks_of_task), 1));
  executor.for_ranges(d.size(), disks_of_task, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double final_radius = target[d.id[i]];
      after[i] = grown_radius(d, box, final_radius, grid, cells, columns, i, tally[b].overlap);
      tally[b].add(columns.before[i], after[i], final_radius);
    }
  });
  d.radius.swap(after);
  for (std::size_t b = 1; b < tally.size(); ++b) tally[0].add(tally[b]);
  return tally[0];
}

GrowthTools parallel_growth(const Executor& executor, const Threads& threads) {
  GrowthTools tools;
  tools.fly = [threads](const Scene& scene, State state, const std::function<void()>& look) {
    const auto engine = make_parallel_exact(scene, std::move(state), threads);
    engine->forget_paths();
    while (engine->state().time < scene.run.t_end) {
      engine->step();
      look();
    }
    return engine->state();
  };
  tools.step = [&executor](Disks& d, const Domain& box, const std::vector<double>& target) {
    return parallel_grow_step(executor, d, box, target);
  };
  return tools;
}

}  // namespace carom
