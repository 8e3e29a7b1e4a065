#include "parallel/slabs/slab_stepping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/physics/push_apart.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"
#include "core/step/thermostat.hpp"
#include "parallel/kicks/draw_velocities.hpp"
#include "parallel/kicks/kick_all.hpp"
#include "parallel/slabs/rank_sums.hpp"
#include "parallel/stepping/drift_blocks.hpp"
#include "parallel/stepping/finish_disk.hpp"
#include "parallel/stepping/mark_gone.hpp"
#include "parallel/stepping/resolve_crowded.hpp"
#include "parallel/stepping/sort_rule.hpp"
#include "parallel/stepping/wall_reach.hpp"

namespace carom {

namespace {

// All disks are sent to the rank whose slab they are in when one has used up this share of the room beyond its own
// slab.
constexpr double excursion_share = 0.5;
// But not before it is this far beyond its slab, in largest radii.
constexpr double usual_excursion = 2.0;

// Of a contact that two ranks resolve, that of the disk with the smaller id counts the impact.
struct OtherRanks {
  Ranks& ranks;
  const GhostDisks& ghosts;
  static constexpr bool alone = false;
  bool any(bool here) const { return ranks.any(here); }
  bool counts(const ContactEvent& e) const { return !ghosts.is_ghost(e.i1); }
};

}  // namespace

SlabStepping::SlabStepping(const Scene& scene, State part, const SlabStart& start, const Threads& threads, Ranks& ranks)
    : scene_(scene),
      state_(std::move(part)),
      obstacles_(place_run_obstacles(scene_, state_)),
      ranks_(ranks),
      executor_(threads.count, threads.block_divisor),
      cut_(start.cut),
      columns_(start.columns),
      smallest_radius_(start.smallest_radius),
      largest_radius_(start.largest_radius),
      border_contacts_(ranks),
      border_rounds_(ranks),
      disks_(start.disks) {
  slab_ = slab_of(cut_, scene_.box, ranks.rank());
  if (disks_ > 0) make_cells(start.counts);
}

// Cells are as wide as on one machine, for all disks, but only those of the slab are made.
void SlabStepping::make_cells(const std::vector<std::size_t>& counts) {
  make_grid(scene_.box, largest_radius_, counts, cells_.grid, stepping_margin);
  keep_rows(cells_.grid, slab_.low, slab_.high);
}

void SlabStepping::release_memory() {
  if (!std::exchange(closed_up_, true)) contacts_kept_ = contacts_found();
  sort_due_ = true;
  for (auto* scratch : {&cells_.sorted.key, &cells_.sorted.start}) std::vector<std::uint32_t>().swap(*scratch);
  release_sort_scratch(cells_.sorted);
  cells_.coarse = {};
  found_ = {};
}

double SlabStepping::disks_at(double /*t*/, Disks& out) const {
  out = state_.disks;
  return state_.time;
}

std::vector<DiskContact> SlabStepping::contacts() const {
  return closed_up_ ? contacts_kept_ : contacts_found();
}

// A contact across a border is on the rank of the disk with the smaller id.
std::vector<DiskContact> SlabStepping::contacts_found() const {
  std::vector<DiskContact> met;
  const std::vector<DiskId>& id = state_.disks.id;
  for (std::size_t b = 0; b + 1 < found_.used; ++b) {
    for (const auto& [i, j] : found_.buffers[b]) {
      const auto [id1, id2] = std::minmax(id[i], id[j]);
      met.push_back({id1, id2, state_.time});
    }
  }
  for (const auto& [own, ghost] : crossing_ids_) {
    if (own < ghost) met.push_back({own, ghost, state_.time});
  }
  return met;
}

void SlabStepping::start_interval(double t, double dt, Count step) {
  if (t == 0.0) remove_at_sinks();
  if (scene_.sources.empty() && !(scene_.physics.diffusion > 0.0)) return;
  const PhaseTimer timer(times_, "start");
  if (!scene_.sources.empty()) emit_from_sources(t, step);
  if (!(scene_.physics.diffusion > 0.0)) return;
  speed2_ = draw_velocities(state_.disks, scene_, dt, step, executor_, block_values_);
  ranks_.maximum({&speed2_, 1});
  speed2_known_ = true;
  if (!has_brownian_sink(scene_)) return;
  mark_crossing(state_.disks, scene_, dt, step, executor_, gone_, taken_, block_values_);
  remove_gone();
}

void SlabStepping::kick_if_due() {
  if (!is_kick_due(scene_, state_)) return;
  ExactSum heat = kick_all(state_.disks, scene_, state_.intervals++, executor_);
  ranks_.sum(heat.digits());
  state_.counters.thermostat_heat += heat.value();
  speed2_known_ = false;
}

double SlabStepping::smallest_of_all() const {
  double least = state_.disks.empty() ? -HUGE_VAL : -smallest_radius(state_.disks);
  ranks_.maximum({&least, 1});
  return -least;
}

Count SlabStepping::parts(double dt) {
  if (disks_ == 0) return 1;
  if (!scene_.sources.empty()) smallest_radius_ = smallest_of_all();
  // As in TimeStepping: in most cases a bound is enough to show that the step is safe.
  const double fall = common_travel(scene_, dt, smallest_radius_);
  if (speed2_known_ && (std::sqrt(speed2_) / smallest_radius_ + fall) * dt < 0.99 * safe_travel) return 1;
  if (has_sinks(scene_.box)) smallest_radius_ = smallest_of_all();
  double travel2 = with_view(state_.disks, [&](const auto& d) { return largest_travel2(d, 0, state_.disks.size()); });
  ranks_.maximum({&travel2, 1});
  const Count parts = parts_of_step(travel2, common_travel(scene_, dt, smallest_radius_), dt);
  if (parts > 1) validity_.note_split(state_, dt, parts);
  return parts;
}

void SlabStepping::sort_if_due() {
  if (sort_due_) sort_now();
}

void SlabStepping::sort_now() {
  if (disks_ == 0) return;
  const PhaseTimer timer(times_, "sort");
  // The pairs found refer to disks by their order of storage.
  found_.used = 0;
  crossing_ids_.clear();
  sort_due_ = false;
  if (!scene_.sources.empty()) {
    std::vector<std::size_t> counts = count_classes(state_.disks, largest_radius_);
    sum_counts_over_ranks(ranks_, counts);
    make_cells(counts);
  }
  cut_anew_if_uneven();
  migrate();
  sort_into_cells(state_.disks, cells_.grid, executor_, cells_.sorted);
  if (!state_.disks.empty()) begin_coarse_positions(state_.disks, executor_, cells_);
}

void SlabStepping::drift(double t) {
  const PhaseTimer timer(times_, "drift");
  cells_.coarse.blocks = 0;
  speed2_ = 0.0;
  if (scene_.box.shear.acts()) {
    speed2_ = move_sheared(t);
    if (!state_.disks.empty()) note_coarse_positions(state_.disks, scene_.box, executor_, cells_);
  } else if (!state_.disks.empty()) {
    speed2_ = drift_blocks(state_.disks, scene_.box, scene_.physics.gravity, t, executor_, cells_);
  }
}

// The work of the shear is rounded once for all ranks, as on one machine.
double SlabStepping::move_sheared(double t) {
  ImpactTally tally;
  const double speed2 = carom::move_sheared(state_.disks, scene_.box, t, executor_, tally, sheared_);
  sum_over_ranks(ranks_, scene_.box, tally);
  tally.count_into(state_.counters);
  return speed2;
}

void SlabStepping::search(const StepRules& rules) {
  closed_up_ = false;
  if (!state_.disks.empty() && !cells_.coarse.current) {
    note_coarse_positions(state_.disks, scene_.box, executor_, cells_);
  }
  find_near_borders();
  found_.used = 0;
  strays_ = 0;
  found_.furthest = 0.0;
  if (rules.settles) carom::keep_places(state_.disks, executor_, displaced_);
  if (!state_.disks.empty()) {
    const PhaseTimer timer(times_, "search");
    strays_ = find_contacts(state_.disks, scene_.box, cells_, executor_, found_);
    cells_.coarse.current = false;  // the positions found will change
  }
  if (has_walls(rules.box)) {
    const PhaseTimer timer(times_, "walls");
    find_wall_contacts(state_.disks, rules, executor_, found_);
  }
  see_neighbours();
}

// Agrees on how far disks have left their slabs, and finds those that may touch one of another slab, at about the same
// depth as in the step before. If one has gone too far in the drift, all are sent to the rank whose slab they are in
// now.
void SlabStepping::find_near_borders() {
  if (ranks_.count() == 1 || cells_.grid.levels.empty()) return;
  const PhaseTimer timer(times_, "exchange");
  Disks& d = state_.disks;
  const double depth = excursion_ + 3.0 * largest_radius_;
  carom::find_near_borders(slab_, d, cells_, depth, near_);
  excursion_ = excursion_of(slab_, scene_.box, d, near_);
  ranks_.maximum({&excursion_, 1});
  const double needed = excursion_ + 2.0 * largest_radius_;
  if (excursion_ > room_beyond(cut_, largest_radius_)) {
    sort_now();
    cells_.coarse.blocks = 0;
    if (!d.empty()) note_coarse_positions(d, scene_.box, executor_, cells_);
    excursion_ = 0.0;
    carom::find_near_borders(slab_, d, cells_, 2.0 * largest_radius_, near_);
  } else if (needed > depth) {
    carom::find_near_borders(slab_, d, cells_, needed, near_);
  }
}

// Gets the ghosts, and finds the pairs across the borders, in a buffer behind those of the search.
void SlabStepping::see_neighbours() {
  const PhaseTimer timer(times_, "exchange");
  Disks& d = state_.disks;
  ghosts_.begin(d.size());
  if (ranks_.count() > 1 && !cells_.grid.levels.empty()) {
    find_seen_beyond(slab_, scene_.box, d, near_, largest_radius_, excursion_, seen_);
    const SeenBeyond theirs = exchange_seen(ranks_, seen_);
    ghosts_.add(theirs.below, lower_border, columns_, d);
    ghosts_.add(theirs.above, upper_border, columns_, d);
  }
  if (found_.buffers.size() <= found_.used) found_.buffers.resize(found_.used + 1);
  std::vector<Pair>& crossing = found_.buffers[found_.used++];
  crossing.clear();
  find_crossing_pairs(d, scene_.box, ghosts_, cells_, found_.furthest, crossing);
  crossing_ids_.clear();
  for (const auto& [i, g] : crossing) crossing_ids_.emplace_back(d.id[i], d.id[g]);
}

StepFigures SlabStepping::resolve(const StepRules& rules) {
  const PhaseTimer timer(times_, "resolve");
  ImpactTally tally;
  const double speed2 = rules.settles ? settle_here(rules, tally) : resolve_here(rules, tally);
  drop_ghosts();
  agree(tally, speed2);
  return lists_.figures;
}

// Returns the largest squared speed of disks that had contacts.
double SlabStepping::resolve_here(const StepRules& rules, ImpactTally& tally) {
  Disks& d = state_.disks;
  // A ghost may have contacts that this rank does not know, so none of its contacts counts as alone.
  lists_.contacts.resize(ghosts_.own(), 0);
  lists_.contacts.resize(d.size(), 1);
  double speed2 = resolve_alone_contacts(d, rules, found_, executor_, lists_, tally);
  if (ranks_.count() > 1) {
    border_contacts_.share(state_, columns_, ghosts_, executor_, lists_);
    speed2 = std::max(speed2, resolve_alone_at_border(rules, tally));
  }
  with_view(d, rules, [&](const auto& view) {
    resolve_crowded(view, rules, d, executor_, lists_, tally, OtherRanks{ranks_, ghosts_});
  });
  return std::max(speed2, finish_crowded_contacts(d, rules, executor_, lists_));
}

double SlabStepping::resolve_alone_at_border(const StepRules& rules, ImpactTally& tally) {
  const WallReach walls(rules.box);
  double speed2 = 0.0;
  with_view(state_.disks, rules, [&](const auto& d) {
    for (const ContactEvent& e : border_contacts_.alone()) {
      const PairImpact impact = resolve_pair(d, rules, e.i1, e.i2);
      if (!ghosts_.is_ghost(e.i1)) tally.add_pair(impact);
      push_pair(d, rules.box, e.i1, e.i2, 0.0);
      note_overlap_left(d, rules.box, e, lists_.figures);
      for (const std::uint32_t i : {e.i1, e.i2}) {
        speed2 = std::max(speed2, finish_disk(d, rules.box, walls, i, lists_.figures));
        lists_.contacts[i] = 0;
      }
    }
  });
  return speed2;
}

void SlabStepping::drop_ghosts() {
  truncate(state_.disks, ghosts_.own());
  lists_.contacts.resize(ghosts_.own());
}

// Makes the step's results common to all ranks: its sums and figures, the largest speed, and whether to sort before the
// next step.
void SlabStepping::agree(ImpactTally& tally, double speed2) {
  sum_over_ranks(ranks_, scene_.box, tally);
  tally.count_into(state_.counters);
  if (scene_.box.shear.acts()) speed2 = std::max(speed2, move_sheared(0.0));
  join_over_ranks(ranks_, lists_.figures);
  lists_.figures.inaccurate = tally.inaccurate;
  lists_.figures.inaccurate_at_walls = tally.inaccurate_at_walls;
  const double room = room_beyond(cut_, largest_radius_);
  const bool far = excursion_ > std::min(usual_excursion * largest_radius_, excursion_share * room);
  const bool sort = far || are_many_strays(strays_, state_.disks.size());
  std::array<double, 2> largest{std::max(speed2_, speed2), sort ? 1.0 : 0.0};
  ranks_.maximum(largest);
  speed2_ = largest[0];
  speed2_known_ = true;
  sort_due_ = largest[1] > 0.0;
}

}  // namespace carom
