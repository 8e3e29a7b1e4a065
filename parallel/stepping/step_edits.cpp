// Changes by a program between two steps of time stepping: the cells are kept, and disks that are not in their cells
// are loose (coarse_positions.hpp).
#include <algorithm>
#include <cstdint>

#include "core/step/step_start.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/stepping/time_stepping.hpp"

namespace carom {

namespace {

// All pairs of loose disks are tested in every step: more of them would cost as much as sorting all disks.
constexpr std::size_t most_loose = 256;

// Enters the new disk, which apply() has stored last.
void add_loose(const Disks& d, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  cells.sorted.key.push_back(cells.grid.levels.front().start_key());
  coarse.position.resize(d.size() + coarse_lanes);
  if (!coarse.radius.empty()) coarse.radius.resize(coarse.position.size());
  coarse.loose.push_back(static_cast<std::uint32_t>(d.size() - 1));
}

// To be called before disk i is removed and the last of n takes its place.
void remove_loose(std::size_t i, std::size_t n, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  std::vector<std::uint32_t>& loose = coarse.loose;
  const std::size_t last = n - 1;
  if (!loose.empty() && loose.back() == last) loose.pop_back();
  if (i != last) {
    const auto moved = static_cast<std::uint32_t>(i);
    const auto place = std::lower_bound(loose.begin(), loose.end(), moved);
    if (place == loose.end() || *place != moved) loose.insert(place, moved);
    if (!coarse.radius.empty()) coarse.radius[i] = coarse.radius[last];
  }
  cells.sorted.key.pop_back();
  // If the last disk was in a cell, that cell and the empty ones after it become shorter.
  std::vector<std::uint32_t>& start = cells.sorted.start;
  for (std::size_t k = start.size(); k-- > 0 && start[k] == n;) --start[k];
}

}  // namespace

// Not in a pile: there disks that were pressed together are searched in cells only.
bool TimeStepping::may_be_loose(const Edit& edit) const {
  const Disks& d = state_.disks;
  if (!cells_valid_ || settles(scene_) || cells_.coarse.loose.size() >= most_loose || d.size() < 2) return false;
  if (edit.kind == Edit::Kind::remove) return true;
  return d.radius.empty() ? edit.disk.radius == d.common_radius
                          : edit.disk.radius <= cells_.grid.levels.front().largest_radius;
}

bool TimeStepping::edit(const Edit& edit) {
  const bool comes = edit.kind == Edit::Kind::add, goes = edit.kind == Edit::Kind::remove;
  if (!goes) speed2_ = std::max(speed2_, edit.disk.vx * edit.disk.vx + edit.disk.vy * edit.disk.vy);
  if (comes && smallest_radius_ > 0.0) smallest_radius_ = std::min(smallest_radius_, edit.disk.radius);
  if (goes) smallest_may_be_gone_ = true;
  const bool loose = (comes || goes) && may_be_loose(edit);
  if (loose && goes) remove_loose(edit.index, state_.disks.size(), cells_);
  apply(edit, state_);
  if (loose && comes) add_loose(state_.disks, cells_);
  if ((comes || goes) && !loose) cells_valid_ = false;
  cells_.coarse.current = false;
  return true;
}

bool TimeStepping::visit_near(Vec2 centre, double half_width, double half_height,
                              const std::function<void(std::size_t)>& visit) {
  if (!cells_valid_ || state_.disks.empty()) return false;
  if (excursion_ < 0.0) excursion_ = furthest_excursion(state_.disks, scene_.box, cells_);
  const double reach = std::max(half_width, half_height) + excursion_;
  for (const GridLevel& level : cells_.grid.levels) {
    for_each_run_near(level, cells_.sorted.start.data(), scene_.box, centre.x, centre.y, reach,
                      [&](std::uint32_t first, std::uint32_t last) {
                        for (std::size_t i = first; i < last; ++i) visit(i);
                      });
  }
  for (const std::uint32_t i : cells_.coarse.loose) visit(i);
  return true;
}

}  // namespace carom
