#include "parallel/slabs/slab_exact_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/step/step_start.hpp"
#include "parallel/exact/logged_paths.hpp"
#include "parallel/exact/window_passes.hpp"
#include "parallel/slabs/rank_sums.hpp"
#include "parallel/slabs/redistribute.hpp"

namespace carom {

namespace {

// The width of the border zone that docs/scaling.md measures, in mean spacings: up to this distance from a disk that
// the rank does not have, the motion of others may become unknown within a slice. It grows if it proves too small.
constexpr double usual_zone = 10.0;
constexpr double usual_zone_of_cut_work = 5.0;
constexpr double zone_of_retry = 1.5;  // factor after a try in vain
// The depth at which ghosts are chosen is this factor times the depth needed: new ghosts are due when a little less
// than one over it is left.
constexpr double depth_in_reserve = 1.45;
// Disks that a rank does not have are assumed to come nearer in a window by this share of the fastest disk's flight; by
// more after they have, and by less again after windows in which they have not.
constexpr double usual_approach = 0.5;
constexpr double approach_of_retry = 1.5;
constexpr double approach_after_window = 0.99;
// A slab shows its neighbours at most this share of its thickness.
constexpr double most_shown = 0.9;
// The number of windows that one rank runs if slabs would be too thin, or a window was crowded.
constexpr int windows_alone_if_thin = 64;
constexpr int windows_alone_if_crowded = 16;

}  // namespace

SlabExact::SlabExact(const Scene& scene, State part, const SlabStart& start, const Threads& threads, Ranks& ranks)
    : scene_(scene),
      state_(std::move(part)),
      obstacles_(place_run_obstacles(scene_, state_)),
      ranks_(ranks),
      executor_(threads.count, threads.block_divisor),
      start_(start),
      cut_(start.cut),
      ghosts_(ranks),
      windows_(scene_, state_, executor_, times_),
      lone_(scene, threads, ranks),
      first_zone_(threads.block_divisor > 1 ? usual_zone_of_cut_work : usual_zone),
      zone_(first_zone_),
      approach_(usual_approach),
      takes_(has_sinks(scene_.box)) {
  windows_.set_ghosts(&ghosts_, start.largest_radius);
}

void SlabExact::step() {
  if (!(state_.time < scene_.run.t_end)) return;
  own_.reset();
  logged_.reset();
  at_start_ = {};
  if (alone_ == 0 && lone_.runs()) lone_.end(state_, start_.columns, start_.disks);
  if (alone_ != 0) return step_alone();
  start_window();
  const SpeedSummary speeds = speeds_of_all();
  WindowPlan plan = plan_window(scene_, state_, start_.disks, speeds);
  if (obstacles_) obstacles_->follow(plan.start, plan.end);
  if (!run_window(plan, speeds)) return step_alone();
  finish(plan);
}

void SlabExact::step_alone() {
  lone_.step(state_);
  --alone_;
}

void SlabExact::release_memory() {
  logged_.reset();
  own_.reset();
  ghosts_.drop(state_);
  windows_.release_memory();
  lone_.release_memory();
}

const SlabCut* SlabExact::slab_cut() const {
  const bool thick = cut_.thinnest() >= least_thickness * start_.largest_radius;
  return !lone_.runs() && thick && left_ <= room_beyond(cut_, start_.largest_radius) ? &cut_ : nullptr;
}

// Rank 0 gets all disks for this number of windows.
void SlabExact::run_alone(int windows) {
  ghosts_.drop(state_);
  windows_.release_memory();
  zone_ = first_zone_;
  lone_.begin(start_.columns, state_);
  alone_ = windows;
}

SpeedSummary SlabExact::speeds_of_all() const {
  SpeedTally tally;
  ghosts_.visit_own(state_.disks.size(),
                    [&](std::size_t begin, std::size_t end) { tally.add(state_.disks, scene_.box, begin, end); });
  ranks_.sum(tally.squares.digits());
  ranks_.maximum({&tally.largest2, 1});
  return summarise_speeds(tally, start_.disks);
}

// Returns false if slabs cannot run the window; rank 0 has all disks then.
bool SlabExact::run_window(WindowPlan& plan, const SpeedSummary& speeds) {
  double margin = speed_margin;
  for (int retries = 0; retries < most_retries;) {
    const double fall = scene_.physics.gravity.size * plan.length;
    if (!prepare_lists(plan, margin * std::sqrt(speeds.largest2) + 2.0 * fall)) {
      warn_of_thin_slabs();
      run_alone(windows_alone_if_thin);
      return false;
    }
    const SliceOutcome outcome = windows_.run(plan, speeds, start_.disks, margin);
    if (outcome == SliceOutcome::done) {
      approach_ = std::max(usual_approach, approach_after_window * approach_);
      return true;
    }
    windows_.forget(Known::nothing);
    if (outcome == SliceOutcome::crowded) break;
    if (outcome == SliceOutcome::ghosts_too_few) {
      zone_ *= zone_of_retry;
    } else if (outcome == SliceOutcome::strangers_too_near) {
      approach_ = std::min(1.0, approach_of_retry * approach_);
    } else {
      margin *= margin_of_retry;
      ++retries;
    }
  }
  run_alone(windows_alone_if_crowded);
  return false;
}

void SlabExact::warn_of_thin_slabs() {
  if (thin_told_) return;
  thin_told_ = true;
  warnings_.push_back(
      fmt::format("exact: {} slabs are too thin at t = {:g}, as disks depend on others beyond the neighbouring slab: "
                  "while this lasts, one rank runs all disks; use fewer ranks, or a higher box",
                  ranks_.count(), state_.time));
}

// If it is due on any rank, distributes the disks among the ranks, with new ghosts, and lists them. Returns false if
// slabs would be too thin.
bool SlabExact::prepare_lists(const WindowPlan& plan, double fastest) {
  bool due = windows_.lists_due(plan);
  if (ranks_.any(due)) return share_out(plan, fastest);
  ghosts_.look_beyond(state_.disks, approach_in(plan, fastest));
  return !ranks_.any(ghosts_.are_few()) || share_out(plan, fastest);
}

bool SlabExact::share_out(const WindowPlan& plan, double fastest) {
  const PhaseTimer timer(times_, "exchange");
  windows_.forget_lists();
  ghosts_.drop(state_);
  cut_ = cut_by_rows_of_all(ranks_, scene_.box, state_.disks);
  redistribute(ranks_, cut_, start_.columns, state_);
  const std::optional<double> depth = ghost_depth(plan, fastest);
  if (!depth) return false;
  const Slab slab = slab_of(cut_, scene_.box, ranks_.rank());
  ghosts_.see(slab, scene_.box, *depth, start_.columns, state_);
  windows_.build_lists(plan, layout_of_rank(state_.disks.size(), static_cast<std::size_t>(start_.disks),
                                            slab.low - *depth, slab.high + *depth, executor_));
  ghosts_.find_places(state_.disks);
  ghosts_.look_beyond(state_.disks, approach_in(plan, fastest));
  return true;
}

// A little more than the fastest disk's flight, so that rounding does not matter.
Approach SlabExact::approach_in(const WindowPlan& plan, double fastest) const {
  const double furthest = fastest * plan.length * (1.0 + 1e-6) + 1e-12 * scene_.box.height;
  return {furthest, approach_ * furthest, cut_.thinnest()};
}

// Nothing if slabs are too thin. Windows may have become twice as long when new ghosts are due.
std::optional<double> SlabExact::ghost_depth(const WindowPlan& plan, double fastest) const {
  const Domain& box = scene_.box;
  const double spacing = std::sqrt(box.width * box.height / static_cast<double>(std::max<Count>(1, start_.disks)));
  const double reach = 2.0 * start_.largest_radius + 2.0 * spacing;
  const double nearer =
      std::max(approach_ * fastest * 2.0 * plan.length, std::min(ghosts_.slice_flight(), fastest * plan.length));
  const double depth = depth_in_reserve * (zone_ * spacing + reach + nearer);
  double thickest = 0.0;
  for (int r = 0; r < cut_.ranks(); ++r) thickest = std::max(thickest, cut_.high(r) - cut_.low(r));
  const bool fits =
      depth <= most_shown * cut_.thinnest() && (!box.periodic_y() || thickest + 2.0 * depth / most_shown <= box.height);
  if (!fits) return {};
  return depth;
}

void SlabExact::finish(const WindowPlan& plan) {
  ImpactTally tally = windows_.store_paths(plan, gone_);
  left_ = ghosts_.most_excursion() + windows_.window().speed_bound * plan.length;
  seen_ghosts_ = ghosts_.count();
  logged_ = plan;
  WindowDisks at_start;
  if (takes_) at_start = {state_.disks, ghosts_.ghosts_among(state_.disks.size())};
  const bool any_gone = remove_gone();
  if (any_gone) at_start_ = std::move(at_start);
  sum_over_ranks(ranks_, scene_.box, tally);
  // Counted here, since finish_window knows only this rank.
  if (any_gone) count_taken_on_ranks(ranks_, std::exchange(tally.taken, {}), state_.taken);
  finish_window(state_, start_.disks, plan, tally);
  StepFigures figures;
  figures.inaccurate = tally.all_inaccurate();
  if (walls_are_watched(scene_)) {
    figures.wall = deepest_wall_overlap(state_.disks, box_at(scene_.box, state_.time), executor_);
    join_over_ranks(ranks_, figures);
  }
  validity_.note_step(scene_, figures, state_);
  check_pace(scene_, state_, plan, tally);
}

const State& SlabExact::state() const {
  if (lone_.runs()) return lone_.state(state_);
  if (!ghosts_.any()) return state_;
  if (!own_) {
    own_ = state_;
    remove_marked(own_->disks, ghosts_.ghosts_among(own_->disks.size()));
  }
  return *own_;
}

double SlabExact::disks_at(double t, Disks& out) const {
  if (lone_.runs()) return lone_.disks_at(t, state_, out);
  if (!(t < state_.time) || !windows_.window().keeps_paths || !logged_) {
    out = state().disks;
    return state_.time;
  }
  const bool any_left = !at_start_.ghosts.empty();
  out = any_left ? at_start_.disks : state_.disks;
  const double at = std::max(t, logged_->start);
  const double s = at - logged_->start;
  move_along_paths(windows_.window(), windows_.scheduler(), s, windows_.window().rules.box,
                   any_left ? at_start_.ghosts : ghosts_.ghosts_among(out.size()), out);
  return at;
}

// Returns a function that says whether a disk of the last window is this rank's own.
std::function<bool(std::uint32_t)> SlabExact::owned() const {
  const bool any_left = !at_start_.ghosts.empty();
  return [this, any_left](std::uint32_t i) { return any_left ? at_start_.ghosts[i] == 0 : !ghosts_.is_ghost(i); };
}

double SlabExact::fastest_within() const {
  if (lone_.runs()) return lone_.fastest_within();
  if (!windows_.window().keeps_paths || !logged_) return 0.0;
  return fastest_of_window(windows_.scheduler(), owned());
}

// A contact across a border is on the rank of the disk with the smaller id.
std::vector<DiskContact> SlabExact::contacts() const {
  if (lone_.runs()) return lone_.contacts();
  if (!windows_.window().keeps_paths || !logged_) return {};
  const bool any_left = !at_start_.ghosts.empty();
  return contacts_of_window(windows_.scheduler(), any_left ? at_start_.disks.id : state_.disks.id, logged_->start,
                            owned());
}

std::vector<std::string> SlabExact::take_warnings() {
  std::vector<std::string> all = validity_.take_warnings();
  for (const std::string& warning : lone_.take_warnings()) all.push_back(warning);
  all.insert(all.end(), warnings_.begin(), warnings_.end());
  warnings_.clear();
  return all;
}

}  // namespace carom
