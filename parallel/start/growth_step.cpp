#include "parallel/start/growth_step.hpp"

#include <algorithm>
#include <array>
#include <atomic>

#include "core/physics/disk_pair.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
#include "parallel/cells/nearby_runs.hpp"

namespace carom {

namespace {

constexpr std::size_t disks_of_task = 2048;  // so many that starting a task costs nothing beside them
constexpr std::size_t disks_at_once = 256;   // of sums

// Data of a step beside the disks, in their storage order; lengths.
struct GrowthColumns {
  std::vector<double> before;  // radii before the step
  std::vector<double> after;   // radii after the step
  std::vector<double> lack;    // target - radius before
};

// The column of radii holds the reach of every disk; the radii are in columns.
struct GrowingDisks {
  const Disks& disks;
  const Domain& box;
  const GrowthColumns& columns;
  bool lack_something;  // does any disk?
};

// Replaces the radii by the reach.
void set_reach(const Executor& executor, Disks& d, const std::vector<double>& target) {
  executor.for_ranges(d.size(), disks_of_task, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) d.radius[i] = growth_reach(d.radius[i], target[d.id[i]]);
  });
}

// Returns whether any disk lacks something.
bool set_lack(const Executor& executor, const Disks& d, const std::vector<double>& target, GrowthColumns& columns) {
  columns.lack.resize(d.size());
  columns.after.resize(d.size());
  std::vector<double> most(executor.blocks(d.size(), disks_of_task), 0.0);
  executor.for_ranges(d.size(), disks_of_task, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      columns.lack[i] = target[d.id[i]] - columns.before[i];
      most[b] = std::max(most[b], columns.lack[i]);
    }
  });
  return std::any_of(most.begin(), most.end(), [](double lack) { return lack > 0.0; });
}

// The radius of disk i that all gaps around it allow. visit(look) calls look(j) for all disks that may be within reach,
// and for i itself; each pair is treated from both of its ends, so that no thread waits for another.
template <class Visit>
double grown_radius(const GrowingDisks& all, double target, std::size_t i, std::atomic<bool>& overlaps, Visit&& visit) {
  const Disks& d = all.disks;
  const Domain& box = all.box;
  const double length = std::max(box.width, box.height);
  const double radius = all.columns.before[i];
  const double lack = all.columns.lack[i];
  if (!(lack > 0.0) && all.lack_something) return radius;
  double after = std::min(target, radius_within_sides(box, d.x[i], d.y[i], radius));
  const RoomAtObstacles room = radius_within_obstacles(box, d.x[i], d.y[i], radius, d.radius[i]);
  after = std::min(after, room.radius);
  bool overlap = room.overlap || !within_sides(box, d.x[i], d.y[i], radius);
  visit([&](std::size_t j) {
    const double distance2 = nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box);
    if (j == i || !touches(distance2, d.radius[i] + d.radius[j])) return;
    const double contact = radius + all.columns.before[j];
    overlap = overlap || distance2 < contact * contact;
    if (!(lack > 0.0)) return;
    const double usable = usable_gap(std::sqrt(distance2) - contact, length);
    after = std::min(after, radius_within(radius, lack, all.columns.lack[j], usable));
  });
  if (overlap) overlaps.store(true, std::memory_order_relaxed);
  return after;
}

// Gives the disks their radii after the step, and sums them up.
GrowthTally take_radii(const Executor& executor, Disks& d, const std::vector<double>& target, bool overlap,
                       GrowthColumns& columns) {
  std::vector<GrowthTally> tally(std::max<std::size_t>(executor.blocks(d.size(), disks_of_task), 1));
  executor.for_ranges(d.size(), disks_of_task, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::array<double, disks_at_once> area;
    std::array<double, disks_at_once> lack;
    for (std::size_t first = begin; first < end; first += disks_at_once) {
      const std::size_t count = std::min(disks_at_once, end - first);
      for (std::size_t k = 0; k < count; ++k) {
        const double final_radius = target[d.id[first + k]];
        const double after = columns.after[first + k];
        tally[b].lacking += columns.before[first + k] < final_radius ? 1U : 0U;
        tally[b].most_lack = std::max(tally[b].most_lack, final_radius - after);
        area[k] = after * after;
        lack[k] = final_radius * final_radius - after * after;
      }
      tally[b].area.add(std::span<const double>(area).first(count));
      tally[b].lack.add(std::span<const double>(lack).first(count));
    }
  });
  d.radius.swap(columns.after);
  for (std::size_t b = 1; b < tally.size(); ++b) tally[0].add(tally[b]);
  tally[0].overlap = overlap;
  return tally[0];
}

}  // namespace

GrowthTally grow_by_cells(const Executor& executor, Disks& d, const Domain& box, const std::vector<double>& target) {
  const std::vector<double> radius = d.radius;
  set_reach(executor, d, target);
  const double largest = largest_radius(d);
  const CellGrid grid = make_grid(box, largest, count_classes(d, largest));
  SortedCells cells;
  sort_into_cells(d, grid, executor, cells);
  GrowthColumns columns;
  columns.before.resize(d.size());
  executor.for_ranges(d.size(), disks_of_task, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) columns.before[i] = radius[cells.order[i]];
  });
  std::atomic<bool> overlaps = false;
  const GrowingDisks all{d, box, columns, set_lack(executor, d, target, columns)};
  executor.for_ranges(d.size(), disks_of_task, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      columns.after[i] = grown_radius(all, target[d.id[i]], i, overlaps, [&](const auto& look) {
        for (const GridLevel& level : grid.levels) {
          const double reach = d.radius[i] + level.largest_radius + level.margin;
          for_each_run_near(level, cells.start.data(), box, d.x[i], d.y[i], reach,
                            [&](std::uint32_t first, std::uint32_t last) {
                              for (std::uint32_t j = first; j < last; ++j) look(j);
                            });
        }
      });
    }
  });
  return take_radii(executor, d, target, overlaps, columns);
}

GrowthTally grow_by_lists(const Executor& executor, Disks& d, const Domain& box, const std::vector<double>& target,
                          const VisitNear& visit_lists) {
  GrowthColumns columns;
  columns.before = d.radius;
  set_reach(executor, d, target);
  std::atomic<bool> overlaps = false;
  const GrowingDisks all{d, box, columns, set_lack(executor, d, target, columns)};
  visit_lists([&](std::size_t i, std::span<const std::uint32_t> near) {
    columns.after[i] = grown_radius(all, target[d.id[i]], i, overlaps, [&](const auto& look) {
      for (const std::uint32_t j : near) look(j);
    });
  });
  return take_radii(executor, d, target, overlaps, columns);
}

}  // namespace carom
