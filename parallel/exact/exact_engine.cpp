#include "parallel/exact/exact_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/step/source.hpp"
#include "core/step/step_start.hpp"
#include "core/step/validity.hpp"
#include "core/step/window_length.hpp"
#include "core/step/window_plan.hpp"
#include "core/step/window_start.hpp"
#include "parallel/cells/compact.hpp"
#include "parallel/cells/kick_all.hpp"
#include "parallel/exact/logged_paths.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/slice_scheduler.hpp"
#include "parallel/exact/window_passes.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

namespace {

// Disks a block in passes over all disks.
constexpr std::size_t pass_block = 8192;
// At the start of a window all paths begin anew from rounded coordinates, so that events may come a little earlier than
// they were predicted: disks are predicted again this share of a window early. That is enough where the approach is
// faster than WindowState::slow; slower contacts that are close are predicted at every start.
constexpr double early_share = 1e-3;
// The lists are rebuilt, and the disks sorted, when they have been relisted so many times each: by then neighbours are
// no longer neighbours in storage.
constexpr Count relistings_a_disk = 8;
// A disk that is relisted is listed as far ahead as it flies in this many mean times between its collisions: what it
// has of its velocity after a collision is two fifths. The fewest instructions a collision are at 0.5 to 1 at packing
// fractions of 0.2 and 0.5.
constexpr double lead_in_free_times = 0.7;
// With regions: no disk may become faster in a window than this factor times the fastest one at its start. A window in
// which one does is run again with a larger factor, and at last without regions. With 1.15, 1.25 and 1.35, 21, 2 and 0
// of 100 windows of 50000 disks were in vain; a larger factor makes slices shorter.
constexpr double speed_margin = 1.35;
constexpr double margin_of_retry = 2.5;  // over that of the try before
constexpr int most_retries = 4;

// What is left of the window before, for the next one.
enum class Valid : std::uint8_t {
  nothing,
  lists,            // neighbour lists and storage order
  lists_and_times,  // and the next events' times, on paths that go on
};

class ParallelExact final : public Engine {
 public:
  ParallelExact(const Scene& scene, State initial, const Threads& threads, const BorderWatch& watch)
      : scene_(scene),
        state_(std::move(initial)),
        obstacles_(place_run_obstacles(scene_, state_)),
        predicts_anew_(obstacles_ != nullptr || scene_.box.has_sine_side()),
        executor_(threads.count, threads.block_divisor),
        scheduler_(window_, lists_, executor_) {
    scheduler_.set_border_watch(watch);
  }

  void step() override {
    if (!(state_.time < scene_.run.t_end)) return;
    start_window();
    speeds_ = summarise_speeds(state_.disks, executor_);
    WindowPlan plan = plan_window(scene_, state_, speeds_, 1.0);
    if (obstacles_) obstacles_->follow(plan.start, plan.end);
    logged_.reset();
    if (!run_window_with_retry(plan)) return;
    store_paths(plan);
    check_pace(scene_, state_, plan);
  }

  const State& state() const override { return state_; }
  double disks_at(double t, Disks& out) const override;
  std::vector<DiskContact> contacts() const override;
  void set_watch(const std::function<bool()>& go_on) override { window_.go_on = go_on; }
  void forget_paths() override { window_.keeps_paths = false; }
  void release_memory() override;
  bool edit(const Edit& edit) override;
  bool visit_near(Vec2 centre, double half_width, double half_height,
                  const std::function<void(std::size_t)>& visit) override;
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override { return validity_.take_warnings(); }

 private:
  void start_window();
  bool lists_take(const Edit& edit);
  void begin_brownian();
  bool has_room(const Disk& newcomer) const;
  void remove(const std::vector<unsigned char>& gone);
  bool rebuild_lists_if_due(const WindowPlan& plan, bool regions_allowed);  // returns whether it did
  void load_paths(const WindowPlan& plan, bool rebuilt);
  void load_disk(std::size_t i, const WindowPlan& plan, bool rebuilt);
  double carried_event_time(std::size_t i, const WindowPlan& plan, bool rebuilt) const;
  void set_speed_bound(const WindowPlan& plan, double margin);  // margin: over the largest speed at its start
  bool run_window_with_retry(WindowPlan& plan);
  SliceOutcome run_window(const WindowPlan& plan, double margin, bool regions_allowed);
  void store_paths(const WindowPlan& plan);

  Scene scene_;
  State state_;
  std::unique_ptr<ObstacleCells> obstacles_;  // of scene_.box
  // How much rounding shifts a contact with an obstacle, or with a side that is a sine, depends on how it is touched:
  // all is predicted again at every window's start.
  const bool predicts_anew_;
  Executor executor_;
  Validity validity_;
  PhaseTimes times_;
  SpeedSummary speeds_;
  WindowState window_;
  NeighbourLists lists_;
  SliceScheduler scheduler_;
  double largest_radius_ = 0.0;
  Valid valid_ = Valid::nothing;
  double last_length_ = 0.0;          // of the window before
  double rate_ = 0.0;                 // events per time, of the last slice
  std::optional<WindowPlan> logged_;  // the last window, if its paths are known
  std::vector<unsigned char> gone_;
  Disks at_start_;  // the columns before disks left through sinks in the last window; else empty
  std::vector<double> column_scratch_;
  std::vector<DiskId> id_scratch_;
};

// Sources emit, Brownian disks draw their velocities; those that cross a sink unseen in the interval leave.
void ParallelExact::start_window() {
  const PhaseTimer timer(times_, "start");
  if (!scene_.sources.empty()) {
    const Count before = state_.counters.emitted;
    emit_at_window_start(scene_, state_, [&](const Disk& d) { return has_room(d); });
    if (state_.counters.emitted != before) valid_ = Valid::nothing;
  }
  if (scene_.physics.collapse_contact_time) state_.last_contact.resize(state_.next_id, -never);
  count_thermal_hits(scene_, state_);
  if (brownian_interval_begins(scene_, state_)) begin_brownian();
  if (kick_if_due(scene_, state_, executor_)) valid_ = std::min(valid_, Valid::lists);
  if (side_turns(scene_, state_.time)) valid_ = std::min(valid_, Valid::lists);
}

void ParallelExact::release_memory() {
  window_.release_memory();
  scheduler_.release_calendars();
  lists_ = NeighbourLists();
  logged_.reset();
  valid_ = Valid::nothing;
}

bool ParallelExact::edit(const Edit& edit) {
  // The paths of the last window no longer go with the disks.
  logged_.reset();
  at_start_ = Disks{};
  const bool known = valid_ != Valid::nothing && !scene_.box.shear.acts() && lists_take(edit);
  apply(edit, state_);
  if (!known) {
    valid_ = Valid::nothing;
  } else if (edit.kind == Edit::Kind::add) {
    lists_.append(state_.disks);
  }
  return true;
}

// Makes the change in what is known of the disks, but for a new one's list; false where all is to be made anew. A disk
// whose next event is now is predicted at the start of the next window, with all disks near it.
bool ParallelExact::lists_take(const Edit& edit) {
  const Disks& d = state_.disks;
  const double now = last_length_;
  if (edit.kind == Edit::Kind::set_velocity) {
    window_.next_event_time[edit.index] = now;
    return true;
  }
  if (window_.mode != EngineMode::single_queue || d.size() <= all_pairs_up_to) return false;
  if (edit.kind == Edit::Kind::add) {
    const bool fits = d.radius.empty() ? edit.disk.radius == d.common_radius : edit.disk.radius <= largest_radius_;
    if (!fits) return false;
    window_.record.emplace_back();
    window_.next_event_time.push_back(now);
    return true;
  }
  lists_.remove(static_cast<std::uint32_t>(edit.index), d);
  window_.record[edit.index] = window_.record.back();
  window_.record.pop_back();
  window_.next_event_time[edit.index] = window_.next_event_time.back();
  window_.next_event_time.pop_back();
  return true;
}

bool ParallelExact::visit_near(Vec2 centre, double half_width, double half_height,
                               const std::function<void(std::size_t)>& visit) {
  if (valid_ == Valid::nothing || window_.mode == EngineMode::all_pairs || scene_.box.shear.acts()) return false;
  lists_.visit_near(centre, half_width, half_height, [&](std::uint32_t i) { visit(i); });
  return true;
}

// While sources emit, the lists know the disks that were there before.
bool ParallelExact::has_room(const Disk& newcomer) const {
  const std::size_t listed = valid_ == Valid::nothing ? 0 : window_.record.size();
  bool met = meets(state_.disks, scene_.box, newcomer, listed, state_.disks.size());
  if (met || listed == 0) return !met;
  lists_.visit_possible_overlaps(newcomer.x, newcomer.y, newcomer.radius, [&](std::uint32_t i) {
    met = met || meets(state_.disks, scene_.box, newcomer, i, i + 1);
  });
  return !met;
}

void ParallelExact::begin_brownian() {
  const BrownianInterval interval = begin_brownian_interval(scene_, state_);
  draw_brownian_interval(state_.disks, scene_, interval, executor_, gone_);
  valid_ = std::min(valid_, Valid::lists);
  if (!gone_.empty()) remove(gone_);
}

void ParallelExact::remove(const std::vector<unsigned char>& gone) {
  const std::size_t before = state_.disks.size();
  remove_in_parallel(state_.disks, gone, executor_, column_scratch_, id_scratch_);
  state_.counters.removed += before - state_.disks.size();
  if (state_.disks.size() != before) valid_ = Valid::nothing;
}

bool ParallelExact::rebuild_lists_if_due(const WindowPlan& plan, bool regions_allowed) {
  const bool strained = scene_.box.shear.acts() && lists_.is_strained(plan.end);
  if (valid_ != Valid::nothing && !strained && scheduler_.relisted() <= relistings_a_disk * state_.disks.size())
    return false;
  const PhaseTimer timer(times_, "list");
  // Sorting takes about as much.
  if (state_.disks.size() > disks_of_much_memory) scheduler_.release_calendars();
  const ListLayout layout = choose_layout(state_.disks.size(), scene_.box, regions_allowed, executor_);
  lists_.follow_flow(box_at(scene_.box, plan.start), plan.start, plan.length);
  lists_.build(state_.disks, scene_.box, layout, executor_);
  window_.mode = layout.mode;
  window_.regions = layout.regions;
  window_.looks_ahead = layout.looks_ahead;
  largest_radius_ = largest_radius(state_.disks);
  valid_ = std::max(valid_, Valid::lists);
  // Two disks that did not list each other before cannot touch before one of them reaches its next event, at the latest
  // that of being relisted.
  if (valid_ == Valid::lists_and_times) lists_.sort_along(window_.next_event_time, executor_);
  lists_.release_scratch();
  return true;
}

void ParallelExact::load_paths(const WindowPlan& plan, bool rebuilt) {
  const PhaseTimer timer(times_, "load");
  const Disks& d = state_.disks;
  window_.begin(exact_rules(scene_, d, plan.start), d, plan, speeds_.largest2, largest_radius_);
  // Two disks an event. Where nothing is known yet, a disk is listed where it is.
  lists_.set_lead_time(rate_ > 0.0 ? lead_in_free_times * static_cast<double>(d.size()) / (2.0 * rate_) : 0.0);
  window_.safe_speed2 = lists_.safe_speed2(plan.length, window_.rules.gravity.size);
  window_.last_contact.resize(state_.last_contact.empty() ? 0 : d.size());
  window_.thermal_hits.resize(state_.thermal_hits.empty() ? 0 : d.size());
  executor_.for_ranges(d.size(), pass_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) load_disk(i, plan, rebuilt);
  });
}

void ParallelExact::load_disk(std::size_t i, const WindowPlan& plan, bool rebuilt) {
  const Disks& d = state_.disks;
  DiskRecord& record = window_.record[i];
  // A contact is predicted again, since rounding at the start of paths may make another event the first.
  const bool relists = valid_ == Valid::lists_and_times && !rebuilt && record.partner.is_relist();
  const Partner partner = relists ? Partner::relist() : Partner::none();
  const DiskProgress progress = record.progress;
  record = {{0.0, d.x[i], d.y[i], d.vx[i], d.vy[i]}, d.radius_of(i), d.id[i], partner, 0, 0, progress};
  window_.next_event_time[i] = valid_ == Valid::lists_and_times ? carried_event_time(i, plan, rebuilt) : 0.0;
  if (!window_.last_contact.empty()) window_.last_contact[i] = state_.last_contact[d.id[i]] - plan.start;
  if (!window_.thermal_hits.empty()) window_.thermal_hits[i] = state_.thermal_hits[d.id[i]];
  if (!window_.burst.empty()) window_.burst[i] = {};
}

// The time of an event that was predicted in the window before, a little early.
double ParallelExact::carried_event_time(std::size_t i, const WindowPlan& plan, bool rebuilt) const {
  if (predicts_anew_) return 0.0;
  const double carried = (window_.next_event_time[i] - last_length_) - early_share * last_length_;
  if (!rebuilt) return carried;
  const double relist_at = lists_.earliest_relist_time(static_cast<std::uint32_t>(i), window_.record[i].path, 0.0,
                                                       plan.length, window_.rules.gravity);
  return std::min(carried, relist_at);
}

void ParallelExact::set_speed_bound(const WindowPlan& plan, double margin) {
  const double fall = window_.rules.gravity.size * plan.length;
  const double fastest = margin * std::sqrt(window_.fastest2) + fall;
  window_.speed_limit2 = window_.mode == EngineMode::regions ? fastest * fastest : HUGE_VAL;
  window_.speed_bound = fastest + fall;
}

// Runs the window; again with a larger speed bound where a disk was too fast, and shorter where it is crowded. False:
// given up; the state is as it was.
bool ParallelExact::run_window_with_retry(WindowPlan& plan) {
  double margin = speed_margin;
  int retries = 0;
  bool regions_allowed = true;
  SliceOutcome outcome = run_window(plan, margin, regions_allowed);
  for (; outcome == SliceOutcome::too_fast || outcome == SliceOutcome::crowded;
       outcome = run_window(plan, margin, regions_allowed)) {
    valid_ = Valid::nothing;
    if (outcome == SliceOutcome::crowded) {
      // Only a single queue processes events in canonical order, and can tell at which of them it was too many.
      if (window_.mode != EngineMode::regions) plan = shortened(plan, window_.rules, scheduler_.crowding());
      regions_allowed = false;
      continue;
    }
    if (retries++ == most_retries) {
      throw PhysicsError(
          fmt::format("exact: the speed bound failed after {} retries, at t = {}; please report this scene",
                      most_retries, plan.start));
    }
    if (retries == most_retries) regions_allowed = false;
    margin *= margin_of_retry;
  }
  if (outcome == SliceOutcome::given_up || !regions_allowed) valid_ = Valid::nothing;
  return outcome == SliceOutcome::done;
}

// Unless the outcome is `done`, the state is as it was.
SliceOutcome ParallelExact::run_window(const WindowPlan& plan, double margin, bool regions_allowed) {
  const bool rebuilt = rebuild_lists_if_due(plan, regions_allowed);
  if (scene_.box.shear.acts()) lists_.carry_flow(box_at(scene_.box, plan.start), plan.start);
  load_paths(plan, rebuilt);
  const PhaseTimer timer(times_, "events");
  scheduler_.begin_window(rebuilt);
  set_speed_bound(plan, margin);
  Count before = 0;
  for (double start = 0.0; start < plan.length;) {
    const double end = scheduler_.slice_end(plan.length, start, rate_);
    const double elapsed = std::min(end, plan.length) - start;
    const double per_disk = state_.disks.empty() ? 0.0 : rate_ / static_cast<double>(state_.disks.size());
    const SliceOutcome outcome = scheduler_.run(start, end, per_disk, plan.start);
    if (outcome != SliceOutcome::done) return outcome;
    rate_ = static_cast<double>(scheduler_.events() - before) / elapsed;
    before = scheduler_.events();
    start = end;
  }
  scheduler_.end_window();
  return SliceOutcome::done;
}

void ParallelExact::store_paths(const WindowPlan& plan) {
  const PhaseTimer timer(times_, "store");
  Disks& d = state_.disks;
  const std::size_t n = d.size();
  const bool any_gone = scheduler_.any_gone();
  gone_.assign(any_gone ? n : 0, 0);
  const Domain& box = window_.rules.box;
  std::vector<ImpactTally> crossings(box.shear.acts() ? executor_.blocks(n, pass_block) : 0);
  const auto store = [&](const auto& wrap_path) {
    executor_.for_ranges(n, pass_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        PathSegment p = carried_to(window_.record[i].path, plan.length, window_.rules.gravity);
        if (any_gone && std::isnan(p.x)) {
          gone_[i] = 1;
        } else {
          wrap_path(p, i, b);
        }
        put(p, d, i);
        if (!state_.last_contact.empty()) state_.last_contact[d.id[i]] = plan.start + window_.last_contact[i];
        if (!state_.thermal_hits.empty()) state_.thermal_hits[d.id[i]] = window_.thermal_hits[i];
      }
    });
  };
  if (box.shear.acts()) {
    store([&](PathSegment& p, std::size_t i, std::size_t b) {
      const double work = wrap_with_work(p, d.mass_of(i), box);
      if (work != 0.0) crossings[b].add_shear(0.0, work);
    });
  } else {
    store([&](PathSegment& p, std::size_t, std::size_t) { wrap_into(p, box); });
  }
  if (d.spins()) d.spin = window_.spin;
  at_start_ = any_gone ? d : Disks{};
  if (valid_ == Valid::lists) valid_ = Valid::lists_and_times;
  last_length_ = plan.length;
  logged_ = plan;
  if (any_gone) remove(gone_);
  ImpactTally tally = scheduler_.tally();
  for (const ImpactTally& block : crossings) tally.add(block);
  finish_window(state_, plan, tally, 1.0);
  Overlap wall;
  if (walls_are_watched(scene_)) wall = deepest_wall_overlap(state_.disks, box_at(scene_.box, state_.time), executor_);
  validity_.see_step(scene_, {{}, {}, wall, tally.all_inaccurate()}, state_);
}

double ParallelExact::disks_at(double t, Disks& out) const {
  if (!(t < state_.time) || !window_.keeps_paths || !logged_) {
    out = state_.disks;
    return state_.time;
  }
  out = scheduler_.any_gone() ? at_start_ : state_.disks;
  move_along_paths(window_, scheduler_, t > logged_->start ? t - logged_->start : 0.0, window_.rules.box, out);
  return t;
}

std::vector<DiskContact> ParallelExact::contacts() const {
  if (!window_.keeps_paths || !logged_) return {};
  return contacts_of_window(scheduler_, scheduler_.any_gone() ? at_start_.id : state_.disks.id, logged_->start);
}

}  // namespace

std::unique_ptr<Engine> make_parallel_exact(const Scene& scene, State initial, const Threads& threads,
                                            const BorderWatch& watch) {
  return std::make_unique<ParallelExact>(scene, std::move(initial), threads, watch);
}

}  // namespace carom
