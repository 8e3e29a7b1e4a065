#include "parallel/exact/exact_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/step/source.hpp"
#include "core/step/step_start.hpp"
#include "core/step/thermostat.hpp"
#include "core/step/validity.hpp"
#include "core/step/window_length.hpp"
#include "core/step/window_plan.hpp"
#include "core/step/window_start.hpp"
#include "parallel/cells/compact.hpp"
#include "parallel/exact/halo_windows.hpp"
#include "parallel/exact/logged_paths.hpp"
#include "parallel/exact/window_passes.hpp"
#include "parallel/exact/window_run.hpp"
#include "parallel/kicks/kick_all.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

namespace {

// With more new disks than this in a window, one queue is faster than regions on two threads.
constexpr double most_newcomers_of_regions = 0.5;
// If more than one of this number of disks leaves in a window, making all lists anew is cheaper than removing the
// disks.
constexpr std::size_t disks_per_leaver = 8;
// If a kick changes a larger share of the disks, predicting all of them takes no longer.
constexpr double most_kicked_share = 0.5;

class ParallelExact final : public ExactFlights {
 public:
  ParallelExact(const Scene& scene, State initial, const Threads& threads, const BorderWatch& watch)
      : scene_(scene),
        state_(std::move(initial)),
        obstacles_(place_run_obstacles(scene_, state_)),
        executor_(threads.count, threads.block_divisor),
        windows_(scene_, state_, executor_, times_),
        halos_(scene_, state_, executor_, times_),
        parts_allowed_(!watch) {
    windows_.scheduler().set_border_watch(watch);
  }

  void step() override {
    if (!(state_.time < scene_.run.t_end)) return;
    logged_.reset();
    start_window();
    const SpeedSummary speeds = summarise_speeds(state_.disks, scene_.box, executor_);
    WindowPlan plan = plan_window(scene_, state_, state_.disks.size(), speeds);
    if (obstacles_) obstacles_->follow(plan.start, plan.end);
    if (!run_window_with_retry(plan, speeds)) return;
    finish(plan);
  }

  const State& state() const override { return state_; }
  double disks_at(double t, Disks& out) const override;
  double fastest_within() const override {
    return in_parts_ ? halos_.fastest_within() : fastest_of_window(windows_.scheduler(), [](auto) { return true; });
  }
  std::vector<DiskContact> contacts() const override;
  void set_watch(const std::function<bool()>& go_on) override { windows_.window().go_on = go_on; }
  void forget_paths() override { windows_.window().keeps_paths = false; }
  void release_memory() override;
  bool edit(const Edit& edit) override;
  bool visit_near(Vec2 centre, double half_width, double half_height,
                  const std::function<void(std::size_t)>& visit) override;
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override { return validity_.take_warnings(); }

  void begin_flight(State state, double t_end, double growth, bool keeps_lists) override;
  State end_flight() override;
  double growth() const override { return allowed_growth_; }
  void visit_lists(const VisitList& visit) const override;
  // Lists built from now on allow for this growth.
  void set_growth(double growth) {
    growth_ = growth;
    halos_.set_growth(growth);
  }

 private:
  void start_window();
  bool parts_are_known() const { return in_parts_ && halos_.known() != Known::nothing; }
  bool is_taken(const Edit& edit);
  template <class Add>
  void add_disks(const Add& add);
  void kick_if_it_is_time();
  void change_velocities(std::span<const std::uint32_t> disks);
  void begin_brownian();
  void forget(Known left) {
    windows_.forget(left);
    halos_.forget(left);
  }
  bool has_room(const Disk& newcomer) const;
  void remove(const std::vector<unsigned char>& gone);
  void take_out_leavers();
  void build_lists_if_due(const WindowPlan& plan, bool regions_allowed);
  bool run_window_with_retry(WindowPlan& plan, const SpeedSummary& speeds);
  bool run_whole_with_retry(WindowPlan& plan, const SpeedSummary& speeds);
  void finish(const WindowPlan& plan);

  Scene scene_;
  State state_;
  std::unique_ptr<ObstacleCells> obstacles_;  // of scene_.box
  Executor executor_;
  Validity validity_;
  PhaseTimes times_;
  WindowRun windows_;
  HaloWindows halos_;
  bool parts_allowed_;
  bool in_parts_ = false;             // the last window
  std::optional<WindowPlan> logged_;  // the last window, if its paths are known
  std::vector<unsigned char> gone_;
  Disks at_start_;  // the columns before disks left through sinks in the last window; else empty
  // Their indices in at_start_, the largest first, until they are removed from lists and times: that is done when the
  // next window starts, since frames of the last one need them.
  std::vector<std::size_t> leavers_;
  std::vector<std::uint32_t> kicked_;  // by the last kick, if it changed only some disks
  std::vector<double> column_scratch_;
  std::vector<DiskId> id_scratch_;
  double growth_ = 0.0;          // of flights (ExactFlights)
  double allowed_growth_ = 0.0;  // growth() after a flight
};

// Sources emit, Brownian disks draw their velocities, and those that cross a sink within the interval are removed.
void ParallelExact::start_window() {
  const PhaseTimer timer(times_, "start");
  take_out_leavers();
  if (!scene_.sources.empty()) {
    add_disks([&] { emit_at_window_start(scene_, state_, [&](const Disk& d) { return has_room(d); }); });
  }
  if (scene_.physics.collapse_contact_time) state_.last_contact.resize(state_.next_id, -never);
  count_thermal_hits(scene_, state_);
  if (brownian_interval_begins(scene_, state_)) begin_brownian();
  kick_if_it_is_time();
}

// The thermostat's kick. If it changes only some of the disks, the events of the others are kept.
void ParallelExact::kick_if_it_is_time() {
  const bool for_some = kicked_share(scene_) < most_kicked_share && !scene_.box.shear.acts();
  kicked_.clear();
  if (kick_if_due(scene_, state_, executor_, for_some ? &kicked_ : nullptr) && !for_some) forget(Known::lists);
  if (!kicked_.empty()) change_velocities(kicked_);
}

// The next events of these disks are now: they are predicted when the next window starts, with all disks near them.
void ParallelExact::change_velocities(std::span<const std::uint32_t> disks) {
  if (parts_are_known()) return halos_.change_velocities(disks);
  if (windows_.known() == Known::nothing) return;
  for (const std::uint32_t i : disks) windows_.window().set_next_event_time(i, windows_.length());
}

void ParallelExact::release_memory() {
  leavers_.clear();
  windows_.release_memory();
  halos_.release_memory();
  logged_.reset();
}

bool ParallelExact::edit(const Edit& edit) {
  // The paths of the last window no longer belong to the disks.
  logged_.reset();
  take_out_leavers();
  if (edit.kind == Edit::Kind::add) {
    add_disks([&] { apply(edit, state_); });
    return true;
  }
  const bool known = parts_are_known() || (windows_.known() != Known::nothing && !scene_.box.shear.acts());
  const bool taken = known && is_taken(edit);
  apply(edit, state_);
  if (!taken) forget(Known::nothing);
  return true;
}

// add() appends disks to the state. The lists of a single queue can take them; otherwise all lists are made anew.
template <class Add>
void ParallelExact::add_disks(const Add& add) {
  const Disks& d = state_.disks;
  const std::size_t before = d.size();
  const bool equal_radii = d.radius.empty();
  const bool takes = windows_.takes_changes();
  add();
  if (d.size() == before) return;
  bool fits = d.radius.empty() || !equal_radii;
  for (std::size_t i = before; i < d.size(); ++i) fits = fits && d.radius_of(i) <= windows_.largest_radius();
  if (takes && fits) {
    windows_.append_disks(before);
  } else {
    forget(Known::nothing);
  }
}

// Applies the change to what is known of the disks; returns false if that becomes invalid, as parts do without a disk.
bool ParallelExact::is_taken(const Edit& edit) {
  if (edit.kind == Edit::Kind::set_velocity) {
    const auto i = static_cast<std::uint32_t>(edit.index);
    change_velocities({&i, 1});
    return true;
  }
  if (parts_are_known() || !windows_.takes_changes()) return false;
  windows_.remove_disk(edit.index, state_.disks);
  return true;
}

bool ParallelExact::visit_near(Vec2 centre, double half_width, double half_height,
                               const std::function<void(std::size_t)>& visit) {
  if (parts_are_known()) {
    halos_.visit_near(centre, half_width, half_height, visit);
    return true;
  }
  const bool listed = windows_.known() != Known::nothing && windows_.window().mode != EngineMode::all_pairs;
  if (!listed || !leavers_.empty() || scene_.box.shear.acts()) return false;
  windows_.lists().visit_near(centre, half_width, half_height, [&](std::uint32_t i) { visit(i); });
  return true;
}

// While sources emit, the lists hold the disks that were there before.
bool ParallelExact::has_room(const Disk& newcomer) const {
  const std::size_t listed = windows_.known() == Known::nothing ? 0 : windows_.window().record.size();
  bool met = meets(state_.disks, scene_.box, newcomer, listed, state_.disks.size());
  if (met || listed == 0) return !met;
  windows_.lists().visit_possible_overlaps(newcomer.x, newcomer.y, newcomer.radius, [&](std::uint32_t i) {
    met = met || meets(state_.disks, scene_.box, newcomer, i, i + 1);
  });
  return !met;
}

void ParallelExact::begin_brownian() {
  const BrownianInterval interval = begin_brownian_interval(scene_, state_);
  draw_brownian_interval(state_.disks, scene_, interval, executor_, gone_);
  forget(Known::lists);
  count_crossed(state_.disks, scene_, interval, gone_, 0, gone_.size(), state_.taken);
  if (!gone_.empty()) remove(gone_);
  take_out_leavers();
}

// Removes marked disks from the state, and from lists and times when the next window starts (leavers_).
void ParallelExact::remove(const std::vector<unsigned char>& gone) {
  leavers_.clear();
  for (std::size_t i = gone.size(); i-- > 0;) {
    if (gone[i] != 0) leavers_.push_back(i);
  }
  if (leavers_.empty()) return;
  at_start_ = state_.disks;
  state_.counters.removed += leavers_.size();
  if (windows_.takes_changes() && leavers_.size() * disks_per_leaver <= gone.size()) {
    for (const std::size_t i : leavers_) take_out(state_.disks, i);
    return;
  }
  remove_in_parallel(state_.disks, gone, executor_, column_scratch_, id_scratch_);
  forget(Known::nothing);
  leavers_.clear();
}

void ParallelExact::take_out_leavers() {
  for (const std::size_t i : leavers_) {
    windows_.remove_disk(i, at_start_);
    take_out(at_start_, i);
  }
  leavers_.clear();
  at_start_ = Disks{};
}

void ParallelExact::build_lists_if_due(const WindowPlan& plan, bool regions_allowed) {
  if (!windows_.lists_due(plan)) return;
  // Regions take no changes: their lists are built anew. If disks leave through sinks, that is once in a window of full
  // length, and faster than one queue; but each newcomer ends a window.
  regions_allowed = regions_allowed && emission_rate(scene_, state_) * plan.meant < most_newcomers_of_regions;
  ListLayout layout = choose_layout(state_.disks.size(), scene_.box, regions_allowed, executor_);
  layout.growth = growth_;
  windows_.build_lists(plan, layout);
}

// Runs the window, in parts if possible; otherwise as a whole, again with a larger speed bound if a disk was too fast,
// and shorter if it is crowded. Returns false if it was interrupted; the state is then unchanged.
bool ParallelExact::run_window_with_retry(WindowPlan& plan, const SpeedSummary& speeds) {
  in_parts_ = parts_allowed_ && halos_.are_wanted();
  if (!in_parts_) halos_.release_memory();
  if (in_parts_) {
    if (!windows_.window().record.empty()) windows_.release_memory();
    const SliceOutcome outcome = halos_.run(plan, speeds, windows_.window());
    if (outcome == SliceOutcome::done) return true;
    in_parts_ = false;
    halos_.release_memory();
    if (outcome == SliceOutcome::given_up) return false;
  }
  return run_whole_with_retry(plan, speeds);
}

bool ParallelExact::run_whole_with_retry(WindowPlan& plan, const SpeedSummary& speeds) {
  double margin = speed_margin;
  int retries = 0;
  bool regions_allowed = true;
  const auto run = [&] {
    build_lists_if_due(plan, regions_allowed);
    return windows_.run(plan, speeds, state_.disks.size(), margin);
  };
  SliceOutcome outcome = run();
  for (; outcome == SliceOutcome::too_fast || outcome == SliceOutcome::crowded; outcome = run()) {
    forget(Known::nothing);
    if (outcome == SliceOutcome::crowded) {
      // Only a single queue processes events in canonical order, and knows at which of them there were too many.
      const WindowState& window = windows_.window();
      if (window.mode != EngineMode::regions) plan = shortened(plan, window.rules, windows_.scheduler().crowding());
      regions_allowed = false;
      continue;
    }
    if (retries++ == most_retries) fail_speed_bound(plan);
    if (retries == most_retries) regions_allowed = false;
    margin *= margin_of_retry;
  }
  if (outcome == SliceOutcome::given_up || !regions_allowed) forget(Known::nothing);
  return outcome == SliceOutcome::done;
}

void ParallelExact::finish(const WindowPlan& plan) {
  gone_.clear();
  const ImpactTally tally = in_parts_ ? halos_.store_paths(plan) : windows_.store_paths(plan, gone_);
  at_start_ = Disks{};
  logged_ = plan;
  if (!gone_.empty()) remove(gone_);
  finish_window(state_, state_.disks.size(), plan, tally);
  Overlap wall;
  if (walls_are_watched(scene_)) wall = deepest_wall_overlap(state_.disks, box_at(scene_.box, state_.time), executor_);
  validity_.note_step(scene_, {.wall = wall, .inaccurate = tally.all_inaccurate()}, state_);
  check_pace(scene_, state_, plan, tally);
}

double ParallelExact::disks_at(double t, Disks& out) const {
  if (!(t < state_.time) || !windows_.window().keeps_paths || !logged_) {
    out = state_.disks;
    return state_.time;
  }
  const double at = std::max(t, logged_->start);
  const double s = at - logged_->start;
  if (in_parts_) {
    out = state_.disks;
    halos_.move_along_paths(s, out);
    return at;
  }
  out = windows_.scheduler().any_gone() ? at_start_ : state_.disks;
  move_along_paths(windows_.window(), windows_.scheduler(), s, windows_.window().rules.box, {}, out);
  return at;
}

std::vector<DiskContact> ParallelExact::contacts() const {
  if (!windows_.window().keeps_paths || !logged_) return {};
  if (in_parts_) return halos_.contacts(logged_->start);
  return contacts_of_window(windows_.scheduler(), windows_.scheduler().any_gone() ? at_start_.id : state_.disks.id,
                            logged_->start, [](std::uint32_t) { return true; });
}

void ParallelExact::begin_flight(State state, double t_end, double growth, bool keeps_lists) {
  state_ = std::move(state);
  scene_.run.t_end = t_end;
  logged_.reset();
  set_growth(growth);
  forget(keeps_lists ? Known::lists : Known::nothing);
  if (parts_are_known()) halos_.take_radii();
}

// The lists of regions do not include all near disks.
State ParallelExact::end_flight() {
  if (parts_are_known()) {
    allowed_growth_ = halos_.complete_lists() ? halos_.growth() : 0.0;
  } else {
    const bool knows_all = windows_.known() != Known::nothing && windows_.window().mode != EngineMode::regions;
    allowed_growth_ = knows_all ? windows_.lists().growth() : 0.0;
  }
  return std::move(state_);
}

void ParallelExact::visit_lists(const VisitList& visit) const {
  if (parts_are_known()) return halos_.visit_lists(visit);
  windows_.lists().visit_lists(executor_, visit);
}

}  // namespace

std::unique_ptr<Engine> make_parallel_exact(const Scene& scene, State initial, const Threads& threads,
                                            const BorderWatch& watch) {
  return std::make_unique<ParallelExact>(scene, std::move(initial), threads, watch);
}

std::unique_ptr<ExactFlights> make_exact_flights(const Scene& scene, State initial, const Threads& threads,
                                                 double growth) {
  auto flights = std::make_unique<ParallelExact>(scene, std::move(initial), threads, BorderWatch{});
  flights->set_growth(growth);
  return flights;
}

}  // namespace carom
