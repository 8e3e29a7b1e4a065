#include "parallel/slabs/slab_exact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/step/step_start.hpp"
#include "core/step/thermostat.hpp"
#include "core/step/validity.hpp"
#include "core/step/window_length.hpp"
#include "core/step/window_plan.hpp"
#include "core/step/window_start.hpp"
#include "parallel/exact/logged_paths.hpp"
#include "parallel/exact/window_passes.hpp"
#include "parallel/exact/window_run.hpp"
#include "parallel/slabs/exact_ghosts.hpp"
#include "parallel/slabs/lone_rank.hpp"
#include "parallel/slabs/rank_sums.hpp"
#include "parallel/slabs/redistribute.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

namespace {

// How far from a disk that is not known others may come to be unknown within a slice, in mean spacings; more where it
// proves to be too little. The border zone that docs/scaling.md measures.
constexpr double usual_zone = 10.0;
constexpr double usual_zone_of_cut_work = 5.0;
constexpr double zone_of_retry = 1.5;  // over that of the try before
// Of the depth at which ghosts are chosen, the share that has to be left when they are chosen anew is a little less
// than one over this.
constexpr double depth_in_reserve = 1.45;
// Of its thickness a slab shows its neighbours so much at most.
constexpr double most_shown = 0.9;
// Where slabs would be too thin, or a window was crowded, one rank runs so many.
constexpr int windows_alone_if_thin = 64;
constexpr int windows_alone_if_crowded = 16;
// Disks a block.
constexpr std::size_t kick_block = 4096;

class SlabExact final : public Engine, public InSlabs {
 public:
  SlabExact(const Scene& scene, State part, const SlabStart& start, const Threads& threads, Ranks& ranks)
      : scene_(scene),
        state_(std::move(part)),
        obstacles_(place_run_obstacles(scene_, state_)),
        ranks_(ranks),
        executor_(threads.count, threads.block_divisor),
        start_(start),
        cut_(start.cut),
        ghosts_(ranks),
        windows_(scene_, state_, executor_, times_),
        lone_(scene, threads, ranks, start),
        first_zone_(threads.block_divisor > 1 ? usual_zone_of_cut_work : usual_zone),
        zone_(first_zone_) {
    windows_.set_ghosts(&ghosts_, start.largest_radius);
  }

  void step() override;
  const State& state() const override;
  const State& progress() const override { return state_; }
  double disks_at(double t, Disks& out) const override;
  std::vector<DiskContact> contacts() const override;
  void forget_paths() override {
    windows_.window().keeps_paths = false;
    lone_.forget_paths();
  }
  void release_memory() override;
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override;
  const SlabCut* slab_cut() const override;

 private:
  void start_window();
  void kick();
  void step_alone();
  void run_alone(int windows);
  SpeedSummary speeds_of_all() const;
  void warn_of_thin_slabs();
  bool run_window(WindowPlan& plan, const SpeedSummary& speeds);
  bool prepare_lists(const WindowPlan& plan, double fastest);
  bool share_out(const WindowPlan& plan, double fastest);
  std::optional<double> ghost_depth(const WindowPlan& plan, double fastest) const;
  void finish(const WindowPlan& plan);
  Disks own_of(const Disks& all) const;

  Scene scene_;
  State state_;  // with ghosts
  std::unique_ptr<ObstacleCells> obstacles_;
  Ranks& ranks_;
  Executor executor_;
  SlabStart start_;
  SlabCut cut_;
  double left_ = 0.0;  // no disk has left its slab by more; length
  Validity validity_;
  PhaseTimes times_;
  ExactGhosts ghosts_;
  WindowRun windows_;
  LoneRank lone_;
  int alone_ = 0;  // windows that one rank has still to run
  const double first_zone_;
  double zone_;             // mean spacings
  bool thin_told_ = false;  // that slabs would be too thin
  std::optional<WindowPlan> logged_;
  std::vector<unsigned char> gone_;
  std::vector<std::string> warnings_;
  mutable std::optional<State> own_;  // since it was asked for after the last step
};

void SlabExact::step() {
  if (!(state_.time < scene_.run.t_end)) return;
  own_.reset();
  logged_.reset();
  if (alone_ == 0 && lone_.runs()) lone_.end(state_);
  if (alone_ != 0) return step_alone();
  if (scene_.physics.collapse_contact_time) state_.last_contact.resize(state_.next_id, -never);
  count_thermal_hits(scene_, state_);
  start_window();
  const SpeedSummary speeds = speeds_of_all();
  WindowPlan plan = plan_window(scene_, state_, start_.disks, speeds, 1.0);
  if (obstacles_) obstacles_->follow(plan.start, plan.end);
  if (!run_window(plan, speeds)) return step_alone();
  finish(plan);
  check_pace(scene_, state_, plan);
}

// What is drawn for a disk, its rank and those that see it as a ghost draw alike.
void SlabExact::start_window() {
  const PhaseTimer timer(times_, "start");
  if (brownian_interval_begins(scene_, state_)) {
    const BrownianInterval interval = begin_brownian_interval(scene_, state_);
    draw_brownian_interval(state_.disks, scene_, interval, executor_, gone_);
    windows_.forget(Known::lists);
  }
  if (is_kick_due(scene_, state_)) kick();
  if (side_turns(scene_, state_.time)) windows_.forget(Known::lists);
}

void SlabExact::kick() {
  const Count number = state_.intervals++;
  const std::size_t n = state_.disks.size();
  std::vector<ExactSum> heat(executor_.blocks(n, kick_block) + 1);
  std::vector<ExactSum> of_ghosts(heat.size());
  with_view(state_.disks, [&](const auto& d) {
    executor_.for_ranges(n, kick_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      ghosts_.visit_runs(begin, end, [&](std::size_t first, std::size_t last, bool is_own) {
        kick_disks(d, scene_, number, first, last, is_own ? heat[b] : of_ghosts[b]);
      });
    });
  });
  for (std::size_t b = 1; b < heat.size(); ++b) heat[0].add(heat[b]);
  ranks_.sum(heat[0].digits());
  state_.counters.thermostat_heat += heat[0].value();
  windows_.forget(Known::lists);
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

// Rank 0 gets all disks for so many windows.
void SlabExact::run_alone(int windows) {
  ghosts_.drop(state_);
  windows_.release_memory();
  zone_ = first_zone_;
  lone_.begin(state_);
  alone_ = windows;
}

SpeedSummary SlabExact::speeds_of_all() const {
  SpeedTally tally;
  ghosts_.visit_own(state_.disks.size(),
                    [&](std::size_t begin, std::size_t end) { tally.add(state_.disks, begin, end); });
  ranks_.sum(tally.squares.digits());
  ranks_.maximum({&tally.largest2, 1});
  return summarise_speeds(tally, start_.disks);
}

// False: slabs cannot run it, and rank 0 has all disks now.
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
    if (outcome == SliceOutcome::done) return true;
    windows_.forget(Known::nothing);
    if (outcome == SliceOutcome::crowded) break;
    if (outcome == SliceOutcome::ghosts_too_few) {
      zone_ *= zone_of_retry;
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
      fmt::format("exact: {} slabs would be thinner than what depends on the disks of others, at t = {:g}: while they "
                  "are, one rank "
                  "runs them all; fewer ranks would do, or a higher box",
                  ranks_.count(), state_.time));
}

// Shares the disks out among the ranks, with new ghosts, and lists them, when on any rank that is due. False: slabs
// would be too thin.
bool SlabExact::prepare_lists(const WindowPlan& plan, double fastest) {
  bool due = windows_.lists_due(plan);
  if (ranks_.any(due)) return share_out(plan, fastest);
  ghosts_.look_beyond(state_.disks);
  return !ranks_.any(ghosts_.are_few()) || share_out(plan, fastest);
}

bool SlabExact::share_out(const WindowPlan& plan, double fastest) {
  const PhaseTimer timer(times_, "exchange");
  ghosts_.drop(state_);
  windows_.forget(Known::lists);
  cut_ = cut_by_rows_of_all(ranks_, scene_.box, state_.disks);
  redistribute(ranks_, cut_, start_.columns, state_);
  const std::optional<double> depth = ghost_depth(plan, fastest);
  if (!depth) return false;
  const Slab slab = slab_of(cut_, scene_.box, ranks_.rank());
  ghosts_.see(slab, scene_.box, *depth, start_.columns, state_);
  windows_.build_lists(plan, layout_of_rank(state_.disks.size(), static_cast<std::size_t>(start_.disks),
                                            slab.low - *depth, slab.high + *depth, executor_));
  ghosts_.find_places(state_.disks);
  ghosts_.look_beyond(state_.disks);
  return true;
}

// None: slabs are too thin. Windows may be twice as long by the time of the next ghosts.
std::optional<double> SlabExact::ghost_depth(const WindowPlan& plan, double fastest) const {
  const Domain& box = scene_.box;
  const double spacing = std::sqrt(box.width * box.height / static_cast<double>(std::max<Count>(1, start_.disks)));
  const double reach = 2.0 * start_.largest_radius + 2.0 * spacing;
  const double depth = depth_in_reserve * (zone_ * spacing + reach + fastest * 2.0 * plan.length);
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
  logged_ = plan;
  sum_over_ranks(ranks_, scene_.box, tally);
  finish_window(state_, start_.disks, plan, tally, 1.0);
  StepFigures figures;
  figures.inaccurate = tally.all_inaccurate();
  if (walls_are_watched(scene_)) {
    figures.wall = deepest_wall_overlap(state_.disks, box_at(scene_.box, state_.time), executor_);
    join_over_ranks(ranks_, figures);
  }
  validity_.see_step(scene_, figures, state_);
}

Disks SlabExact::own_of(const Disks& all) const {
  Disks own = all;
  std::vector<unsigned char> gone(all.size(), 1);
  ghosts_.visit_own(all.size(), [&](std::size_t begin, std::size_t end) { std::fill_n(&gone[begin], end - begin, 0); });
  remove_marked(own, gone);
  return own;
}

const State& SlabExact::state() const {
  if (lone_.runs()) return lone_.state(state_);
  if (!own_) {
    own_ = state_;
    own_->disks = own_of(state_.disks);
  }
  return *own_;
}

double SlabExact::disks_at(double t, Disks& out) const {
  if (lone_.runs()) return lone_.disks_at(t, state_, out);
  if (!(t < state_.time) || !windows_.window().keeps_paths || !logged_) {
    out = state().disks;
    return state_.time;
  }
  out = state_.disks;
  const double s = t > logged_->start ? t - logged_->start : 0.0;
  move_along_paths(windows_.window(), windows_.scheduler(), s, windows_.window().rules.box, out);
  out = own_of(out);
  return t;
}

// Those across a border are on the rank of the disk with the smaller id.
std::vector<DiskContact> SlabExact::contacts() const {
  if (lone_.runs()) return lone_.contacts();
  if (!windows_.window().keeps_paths || !logged_) return {};
  std::vector<DiskId> own(state_.disks.id);
  return contacts_of_window(windows_.scheduler(), state_.disks.id, logged_->start,
                            [this](std::uint32_t i) { return !ghosts_.is_ghost(i); });
}

std::vector<std::string> SlabExact::take_warnings() {
  std::vector<std::string> all = validity_.take_warnings();
  for (const std::string& warning : lone_.take_warnings()) all.push_back(warning);
  all.insert(all.end(), warnings_.begin(), warnings_.end());
  warnings_.clear();
  return all;
}

}  // namespace

std::unique_ptr<Engine> make_slab_exact_part(const Scene& scene, State part, const SlabStart& start,
                                             const Threads& threads, Ranks& ranks) {
  if (ranks.count() == 1 || !start.alone.empty()) return make_lone_part(scene, std::move(part), start, threads, ranks);
  return std::make_unique<SlabExact>(scene, std::move(part), start, threads, ranks);
}

std::unique_ptr<Engine> make_slab_exact(const Scene& scene, State initial, const Threads& threads, Ranks& ranks) {
  const SlabStart start = slab_start(scene, initial.disks, ranks.count());
  keep_own_disks(start.cut, ranks.rank(), initial.disks);
  return make_slab_exact_part(scene, std::move(initial), start, threads, ranks);
}

}  // namespace carom
