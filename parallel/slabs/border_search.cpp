#include "parallel/slabs/border_search.hpp"

#include <algorithm>

#include "core/physics/disk_pair.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/ranks/message.hpp"

namespace carom {

namespace {

// A generous bound for the rounding of a distance from a border; share of the box's height.
constexpr double rounding = 1e-12;

// Storage indices [first, last).
struct Run {
  std::uint32_t first, last;
  bool holds(std::uint32_t i) const { return i >= first && i < last; }
};

// The disks of a level that were sorted into rows up to this one, or from this one on; all disks if the rank does not
// have the row.
Run rows_up_to(const GridLevel& level, const SortedCells& cells, std::uint32_t row) {
  const std::uint32_t rows = std::min(row - level.first_row + 1, level.kept_rows);
  return {cells.start[level.start_key()], cells.start[level.start_key() + rows * level.stride]};
}
Run rows_from(const GridLevel& level, const SortedCells& cells, std::uint32_t row) {
  const std::uint32_t first = row > level.first_row ? row - level.first_row : 0;
  return {cells.start[level.start_key() + first * level.stride], cells.start[level.start_key() + level.keys()]};
}

void add_run(Run run, std::vector<Run>& runs, std::vector<std::uint32_t>& near) {
  for (std::uint32_t i = run.first; i < run.last; ++i) near.push_back(i);
  runs.push_back(run);
}

}  // namespace

Slab slab_of(const SlabCut& cut, const Domain& box, int rank) {
  const int last = cut.ranks() - 1;
  const bool seam = box.periodic_y();
  return {cut.low(rank), cut.high(rank), last > 0 && (seam || rank > 0), last > 0 && (seam || rank < last)};
}

// Measured from the middle of the slab, which may be more than half of a periodic box.
Beyond beyond(const Slab& slab, const Domain& box, double y) {
  const double half = 0.5 * (slab.high - slab.low);
  double off = y - (slab.low + half);
  if (box.periodic_y()) off = nearest_image(off, box.height);
  return {-off - half, off - half};
}

void find_near_borders(const Slab& slab, const Disks& disks, const CellList& cells, double depth,
                       std::vector<std::uint32_t>& near) {
  near.clear();
  if (disks.empty()) return;
  std::vector<Run> runs;
  for (const GridLevel& level : cells.grid.levels) {
    // All disks except strays are within the margin of their cell.
    const double reach = depth + level.margin + rounding * level.rows * level.cell_height;
    Run lower{0, 0};
    if (slab.has_lower) {
      lower = rows_up_to(level, cells.sorted, row_at(level, slab.low + reach));
      add_run(lower, runs, near);
    }
    if (!slab.has_upper) continue;
    Run upper = rows_from(level, cells.sorted, row_at(level, slab.high - reach));
    if (slab.has_lower) upper.first = std::max(upper.first, std::min(lower.last, upper.last));
    add_run(upper, runs, near);
  }
  for (std::size_t b = 0; b < cells.coarse.blocks; ++b) {
    for (const std::uint32_t i : cells.coarse.strays[b]) {
      const bool known = std::any_of(runs.begin(), runs.end(), [&](const Run& run) { return run.holds(i); });
      if (!known) near.push_back(i);
    }
  }
}

double excursion_of(const Slab& slab, const Domain& box, const Disks& disks, const std::vector<std::uint32_t>& near) {
  double furthest = 0.0;
  for (const std::uint32_t i : near) {
    const Beyond b = beyond(slab, box, disks.y[i]);
    if (slab.has_lower) furthest = std::max(furthest, b.lower);
    if (slab.has_upper) furthest = std::max(furthest, b.upper);
  }
  return furthest;
}

void find_seen_beyond(const Slab& slab, const Domain& box, const Disks& disks, const std::vector<std::uint32_t>& near,
                      double largest_radius, double excursion, SeenBeyond& seen) {
  seen.below.clear();
  seen.above.clear();
  for (const std::uint32_t i : near) {
    const double depth = disks.radius_of(i) + largest_radius + excursion + rounding * box.height;
    const Beyond b = beyond(slab, box, disks.y[i]);
    if (slab.has_lower && b.lower >= -depth) seen.below.push_back(disk_at(disks, i));
    if (slab.has_upper && b.upper >= -depth) seen.above.push_back(disk_at(disks, i));
  }
}

SeenBeyond exchange_seen(Ranks& ranks, const SeenBeyond& seen) {
  Bytes to_below;
  Bytes to_above;
  put_all(to_below, seen.below);
  put_all(to_above, seen.above);
  const auto [below, above] = ranks.exchange(to_below, to_above);
  return {MessageReader(below).get_all<Disk>(), MessageReader(above).get_all<Disk>()};
}

void find_crossing_pairs(const Disks& d, const Domain& box, const GhostDisks& ghosts, const CellList& cells,
                         double furthest, std::vector<Pair>& pairs) {
  for (std::size_t k = ghosts.own(); k < d.size(); ++k) {
    const auto g = static_cast<std::uint32_t>(k);
    for (const GridLevel& level : cells.grid.levels) {
      const double reach = d.radius_of(g) + level.largest_radius + std::max(level.margin, furthest);
      for_each_run_near(level, cells.sorted.start.data(), box, d.x[g], d.y[g], reach,
                        [&](std::uint32_t first, std::uint32_t last) {
                          for (std::uint32_t i = first; i < last; ++i) {
                            const double distance2 = nearest_distance2({d.x[i] - d.x[g], d.y[i] - d.y[g]}, box);
                            if (touches(distance2, d.radius_of(i) + d.radius_of(g))) pairs.push_back({i, g});
                          }
                        });
    }
  }
}

}  // namespace carom
