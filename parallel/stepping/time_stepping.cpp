#include "parallel/stepping/time_stepping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/huge_pages.hpp"
#include "core/disks/disk_columns.hpp"
#include "core/step/source.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"
#include "parallel/cells/compact.hpp"
#include "parallel/cells/meets_nearby.hpp"
#include "parallel/kicks/draw_velocities.hpp"
#include "parallel/kicks/kick_all.hpp"
#include "parallel/stepping/drift_blocks.hpp"
#include "parallel/stepping/mark_gone.hpp"
#include "parallel/stepping/sort_rule.hpp"
#include "parallel/stepping/stepping_cells.hpp"
#include "parallel/stepping/wall_reach.hpp"

namespace carom {

namespace {

// Disks in a block of a single pass.
constexpr std::size_t look_block = 8192;

}  // namespace

TimeStepping::TimeStepping(const Scene& scene, State initial, const Threads& threads)
    : scene_(scene),
      state_(std::move(initial)),
      obstacles_(place_run_obstacles(scene_, state_)),
      executor_(threads.count, threads.block_divisor) {
  for_each_column(state_.disks, [](auto& column) { move_to_huge_pages(column); });
}

double TimeStepping::disks_at(double /*t*/, Disks& out) const {
  out = state_.disks;
  return state_.time;
}

// The pairs found name disks by their storage index at the search; sinks may have taken some disks since.
std::vector<DiskContact> TimeStepping::contacts() const {
  std::vector<std::uint32_t> place;  // of each disk then, now
  std::uint32_t kept = 0;
  for (std::size_t i = 0; closed_up_ && i < gone_.size(); ++i) place.push_back(gone_[i] != 0 ? kept : kept++);
  const std::vector<DiskId>& id = state_.disks.id;
  std::vector<DiskContact> met;
  for (std::size_t b = 0; b < found_.used; ++b) {
    for (const auto& [i, j] : found_.buffers[b]) {
      if (closed_up_ && (gone_[i] | gone_[j]) != 0) continue;
      const auto [id1, id2] = std::minmax(id[closed_up_ ? place[i] : i], id[closed_up_ ? place[j] : j]);
      met.push_back({id1, id2, state_.time});
    }
  }
  return met;
}

std::vector<std::string> TimeStepping::take_warnings() {
  return validity_.take_warnings();
}

void TimeStepping::start_interval(double t, double dt, Count step) {
  if (t == 0.0) remove_at_sinks();
  if (scene_.sources.empty() && !(scene_.physics.diffusion > 0.0)) return;
  const PhaseTimer timer(times_, "start");
  if (!scene_.sources.empty()) emit_from_sources(t, step);
  if (scene_.physics.diffusion > 0.0) draw_velocities(dt, step);
}

// A new disk is tested against the disks in the cells around it and against those emitted just before it. The cells are
// made anew at the first test of a step, before any disk has been emitted.
void TimeStepping::emit_from_sources(double t, Count step) {
  const Disks& d = state_.disks;
  std::size_t in_cells = 0;
  bool cells_are_new = false;
  const Count before = state_.counters.emitted;
  emit_due(scene_, state_, t, step, [&](const Disk& newcomer) {
    if (!std::exchange(cells_are_new, true)) {
      if (!d.empty()) sort_now();
      in_cells = d.size();
    }
    bool met = meets(d, scene_.box, newcomer, in_cells, d.size());
    met = met || (in_cells > 0 && meets_nearby(d, scene_.box, cells_.grid, cells_.sorted, newcomer));
    return !met;
  });
  if (state_.counters.emitted == before) return;
  cells_valid_ = false;
  speed2_known_ = false;
}

void TimeStepping::draw_velocities(double dt, Count step) {
  speed2_ = carom::draw_velocities(state_.disks, scene_, dt, step, executor_, block_values_);
  speed2_known_ = true;
  if (has_brownian_sink(scene_)) {
    remove_gone(mark_crossing(state_.disks, scene_, dt, step, executor_, gone_, state_.taken, block_values_));
  }
}

void TimeStepping::kick_if_due() {
  if (carom::kick_if_due(scene_, state_, executor_)) speed2_known_ = false;
}

void TimeStepping::remove_gone(Count marked) {
  if (marked == 0) return;
  remove_in_parallel(state_.disks, gone_, executor_, cells_.sorted.column, cells_.sorted.pass);
  state_.counters.removed += marked;
  cells_valid_ = false;
  closed_up_ = true;
}

double TimeStepping::exact_travel2() {
  block_values_.assign(executor_.blocks(state_.disks.size(), look_block), 0.0);
  with_view(state_.disks, [&](const auto& d) {
    executor_.for_ranges(state_.disks.size(), look_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      block_values_[b] = largest_travel2(d, begin, end);
    });
  });
  double largest = 0.0;
  for (const double t : block_values_) largest = std::max(largest, t);
  return largest;
}

Count TimeStepping::parts(double dt) {
  if (state_.disks.empty()) return 1;
  if (smallest_radius_ == 0.0 || !scene_.sources.empty()) smallest_radius_ = smallest_radius(state_.disks);
  // The bound from earlier phases usually shows that the step is safe; if not, the exact value is computed, which is
  // that of the reference. So it is if sinks may have taken the smallest disk.
  const double fall = common_travel(scene_, dt, smallest_radius_);
  if (speed2_known_ && (std::sqrt(speed2_) / smallest_radius_ + fall) * dt < 0.99 * safe_travel) return 1;
  if (has_sinks(scene_.box) || smallest_may_be_gone_) smallest_radius_ = smallest_radius(state_.disks);
  const Count parts = parts_of_step(exact_travel2(), common_travel(scene_, dt, smallest_radius_), dt);
  if (parts > 1) validity_.note_split(state_, dt, parts);
  return parts;
}

void TimeStepping::sort_if_due() {
  if (state_.disks.empty()) return;
  if (cells_valid_ && !are_many_strays(strays_, state_.disks.size())) return;
  sort_now();
}

void TimeStepping::sort_now() {
  const PhaseTimer timer(times_, "sort");
  make_stepping_cells(state_.disks, scene_.box, class_counts_, cells_.grid);
  sort_into_cells(state_.disks, cells_.grid, executor_, cells_.sorted);
  begin_coarse_positions(state_.disks, executor_, cells_);
  cells_valid_ = true;
  strays_ = 0;
  excursion_ = -1.0;
}

void TimeStepping::drift(double t) {
  const PhaseTimer timer(times_, "drift");
  excursion_ = -1.0;
  speed2_ = 0.0;
  if (scene_.box.shear.acts()) return move_sheared(t);
  if (!state_.disks.empty())
    speed2_ = drift_blocks(state_.disks, scene_.box, scene_.physics.gravity, t, executor_, cells_);
  speed2_known_ = true;
}

// In a sheared box all disks drift and are wrapped here, before their coarse positions are written. t = 0 only wraps
// disks that contacts have moved.
void TimeStepping::move_sheared(double t) {
  ImpactTally tally;
  speed2_ = carom::move_sheared(state_.disks, scene_.box, t, executor_, tally, sheared_);
  tally.count_into(state_.counters);
  speed2_known_ = true;
}

void TimeStepping::search(const StepRules& rules) {
  {
    const PhaseTimer timer(times_, "search");
    found_.used = 0;
    closed_up_ = false;
    strays_ = 0;
    if (!state_.disks.empty()) {
      if (!cells_.coarse.current) note_coarse_positions(state_.disks, scene_.box, executor_, cells_);
      strays_ = find_contacts(state_.disks, scene_.box, cells_, executor_, found_);
      cells_.coarse.current = false;  // resolving will move disks
    }
  }
  if (!has_walls(rules.box)) return;
  const PhaseTimer timer(times_, "walls");
  find_wall_contacts(state_.disks, rules, executor_, found_);
}

StepFigures TimeStepping::resolve(const StepRules& rules) {
  const PhaseTimer timer(times_, "resolve");
  speed2_ = std::max(speed2_, resolve_contacts(state_, rules, found_, executor_, lists_));
  if (scene_.box.shear.acts()) move_sheared(0.0);
  return lists_.figures;
}

void TimeStepping::keep_places() {
  const PhaseTimer timer(times_, "resolve");
  carom::keep_places(state_.disks, executor_, displaced_);
}

bool TimeStepping::presses_others() {
  const PhaseTimer timer(times_, "resolve");
  if (state_.disks.empty()) return false;
  return carom::presses_others(state_.disks, scene_.box, cells_, found_.furthest, executor_, displaced_);
}

void TimeStepping::gather(const StepRules& rules) {
  const PhaseTimer timer(times_, "gather");
  gather_events(state_.disks, rules, found_, executor_, lists_);
}

void TimeStepping::finish_contacts() {
  speed2_ = std::max(speed2_, carom::finish_contacts(state_.disks, scene_.box, executor_, lists_.events, lists_));
}

void TimeStepping::remove_at_sinks() {
  if (!has_sinks(scene_.box)) return;
  const PhaseTimer timer(times_, "sinks");
  remove_gone(mark_at_sinks(state_.disks, scene_.box, executor_, gone_, state_.taken, block_values_));
}

}  // namespace carom
