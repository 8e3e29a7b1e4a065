#include "parallel/exact/exact_engine.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/huge_pages.hpp"
#include "core/step/source.hpp"
#include "core/step/step_start.hpp"
#include "core/step/validity.hpp"
#include "core/step/window_length.hpp"
#include "core/step/window_plan.hpp"
#include "core/step/window_start.hpp"
#include "parallel/cells/compact.hpp"
#include "parallel/exact/exact_lists.hpp"
#include "parallel/exact/exact_sweep.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

namespace {

// Disks a block in passes that look at each disk once.
constexpr std::size_t pass_block = 8192;
// Events are looked for this many windows ahead; a disk without any in sight is looked at again then.
constexpr double windows_ahead = 4.0;
// Where a window starts, paths begin afresh, from rounded places. Events found before may then come a little earlier:
// disks look this share of a window early. It is enough where two meet at more than `slow`, such that rounding shifts
// their meeting by far less; those that are as slow, and so close that they may meet all the same, look at every start.
constexpr double early_share = 1e-3;
constexpr double far_less = 1e5;
// Events a disk a slice: fewer leave less over for other tiles, more save going through all tiles.
constexpr double events_per_slice = 0.25;
// All disks are listed and sorted anew when one in so many has been listed anew by itself.
constexpr std::size_t listed_share = 2;
// Where there are tiles, nobody gets faster within a window than the fastest disk at its start by this factor; a window
// that finds otherwise is done again with a larger one, at last without tiles.
constexpr double allowed_speed = 1.25;
constexpr int most_tries = 4;  // with tiles

class ParallelExact final : public Engine {
 public:
  ParallelExact(const Scene& scene, State initial, const Threads& threads)
      : scene_(scene),
        state_(std::move(initial)),
        executor_(threads.count, threads.block_divisor),
        sweep_(field_, lists_, executor_) {}

  void step() override {
    if (!(state_.time < scene_.run.t_end)) return;
    start_window();
    WindowPlan plan = plan_window(scene_, state_, summarise(), 1.0);
    has_paths_ = false;
    if (!run_window_surely(plan)) return;
    store_paths(plan);
    check_pace(state_, plan);
  }

  const State& state() const override { return state_; }
  double disks_at(double t, Disks& out) const override;
  void set_watch(const std::function<bool()>& go_on) override { field_.go_on = go_on; }
  void forget_paths() override { field_.keeps_paths = false; }
  void release_memory() override;
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override { return validity_.take_warnings(); }

 private:
  void start_window();
  void begin_brownian();
  bool has_room(const Disk& newcomer) const;
  void remove(const std::vector<unsigned char>& gone);
  SpeedSummary summarise();
  void list_if_due();
  void load_paths(const WindowPlan& plan);
  bool run_window_surely(WindowPlan& plan);
  SliceEnd run_window(const WindowPlan& plan, double allowed);
  double slice_end(const WindowPlan& plan, double start) const;
  void store_paths(const WindowPlan& plan);

  Scene scene_;
  State state_;
  Executor executor_;
  Validity validity_;
  PhaseTimes times_;
  SpeedSummary speeds_;
  ExactField field_;
  ExactLists lists_;
  ExactSweep sweep_;
  double largest_radius_ = 0.0;
  bool lists_good_ = false;  // lists_ and field_ go with the storage order
  bool listed_now_ = false;
  bool due_good_ = false;     // so do the due times, on paths that have not changed
  double last_length_ = 0.0;  // of the window before
  double rate_ = 0.0;         // events a time, of the last slice
  bool has_paths_ = false;    // of the last window, which may have had no disk
  WindowPlan last_plan_;
  std::vector<unsigned char> gone_;
  Disks at_start_;  // the columns before the last window's sinks took any; else empty
  std::vector<double> column_scratch_;
  std::vector<DiskId> id_scratch_;
};

// Sources emit, Brownian disks draw their velocities; those that cross a sink unseen in the interval leave.
void ParallelExact::start_window() {
  const PhaseTimer timer(times_, "start");
  if (!scene_.sources.empty()) {
    const Count before = state_.counters.emitted;
    emit_at_window_start(scene_, state_, [&](const Disk& d) { return has_room(d); });
    if (state_.counters.emitted != before) lists_good_ = false;
  }
  if (scene_.physics.collapse_contact_time) state_.last_contact.resize(state_.next_id, -never);
  if (brownian_interval_begins(scene_, state_)) begin_brownian();
}

void ParallelExact::release_memory() {
  std::vector<Flight>().swap(field_.flight);
  std::vector<double>().swap(field_.due);
  std::vector<std::uint32_t>().swap(field_.standing);
  std::vector<std::uint8_t>().swap(field_.mark);
  lists_ = ExactLists();
  has_paths_ = false;
  lists_good_ = due_good_ = false;
}

// While disks come in, the lists still know those that were there before.
bool ParallelExact::has_room(const Disk& newcomer) const {
  const std::size_t listed = lists_good_ ? field_.flight.size() : 0;
  bool met = meets(state_.disks, scene_.box, newcomer, listed, state_.disks.size());
  if (met || listed == 0) return !met;
  lists_.visit_near(newcomer.x, newcomer.y, newcomer.radius + lists_.roam(),
                    [&](std::uint32_t i) { met = met || meets(state_.disks, scene_.box, newcomer, i, i + 1); });
  return !met;
}

void ParallelExact::begin_brownian() {
  const BrownianInterval interval = begin_brownian_interval(scene_, state_);
  const std::size_t n = state_.disks.size();
  const bool sinks = has_brownian_sink(scene_);
  gone_.assign(sinks ? n : 0, 0);
  with_view(state_.disks, [&](const auto& d) {
    executor_.for_ranges(n, pass_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      draw_brownian(d, scene_, interval.number, interval.length, begin, end);
      for (std::size_t i = begin; sinks && i < end; ++i) {
        gone_[i] = crosses_sink(d, scene_, interval.number, interval.length, i) ? 1 : 0;
      }
    });
  });
  due_good_ = false;
  if (sinks) remove(gone_);
}

void ParallelExact::remove(const std::vector<unsigned char>& gone) {
  const std::size_t before = state_.disks.size();
  remove_in_parallel(state_.disks, gone, executor_, column_scratch_, id_scratch_);
  state_.counters.removed += before - state_.disks.size();
  if (state_.disks.size() != before) lists_good_ = false;
}

SpeedSummary ParallelExact::summarise() {
  const Disks& d = state_.disks;
  std::vector<SpeedTally> tally(std::max<std::size_t>(executor_.blocks(d.size(), pass_block), 1));
  executor_.for_ranges(d.size(), pass_block,
                       [&](std::size_t b, std::size_t begin, std::size_t end) { tally[b].add(d, begin, end); });
  for (std::size_t b = 1; b < tally.size(); ++b) tally[0].add(tally[b]);
  speeds_ = summarise_speeds(tally[0], d.size());
  return speeds_;
}

void ParallelExact::list_if_due() {
  if (lists_good_ && sweep_.listed_anew() * listed_share <= state_.disks.size()) return;
  const PhaseTimer timer(times_, "list");
  const bool only_moved = lists_good_ && due_good_;
  const std::size_t n = state_.disks.size();
  lists_.build(state_.disks, scene_.box, sweep_.disks_per_tile(n), sweep_.range_share(n), executor_);
  largest_radius_ = largest_radius(state_.disks);
  lists_good_ = true;
  due_good_ = only_moved;
  listed_now_ = true;
  // Nobody that was not listed before can be met before one of the two is due: to leave its old range at the latest.
  if (only_moved) lists_.sort_along(field_.due, executor_);
  lists_.release_scratch();
}

void ParallelExact::load_paths(const WindowPlan& plan) {
  const PhaseTimer timer(times_, "load");
  const Disks& d = state_.disks;
  const std::size_t n = d.size();
  field_.rules = exact_rules(scene_, d);
  field_.disks = &d;
  field_.length = plan.length;
  field_.horizon = windows_ahead * plan.length;
  field_.next_start = std::nextafter(plan.length, never);
  field_.most_paths = most_paths(n);
  field_.safe_speed2 = lists_.safe_speed2(plan.length, field_.rules.gravity);
  field_.fastest2 = speeds_.largest2;
  if (field_.flight.capacity() < n) resize_in_huge_pages(field_.flight, n);
  if (field_.due.capacity() < n) resize_in_huge_pages(field_.due, n);
  field_.flight.resize(n);
  field_.due.resize(n);
  field_.slack = 1e-9 * 2.0 * largest_radius_ + 1e-14 * std::max(scene_.box.width, scene_.box.height);
  const double g = field_.rules.gravity;
  // Places, and ways that velocities make in the windows ahead, are rounded to this.
  const double fastest = std::sqrt(field_.fastest2) + g * plan.length;
  const double rounding = 0x1p-51 * (std::max(scene_.box.width, scene_.box.height) + fastest * field_.horizon);
  field_.close = 4.0 * far_less * rounding;
  field_.slow = far_less * rounding / plan.length;
  field_.largest_radius = largest_radius_;
  const bool tc = !state_.last_contact.empty();
  field_.last_contact.resize(tc ? n : 0);
  const bool may_collapse = dissipates(scene_.box, field_.rules.restitution);
  field_.burst.resize(may_collapse ? n : 0);
  executor_.for_ranges(n, pass_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Flight& f = field_.flight[i];
      // The rounding of paths that begin afresh may make other events the first.
      const std::uint32_t partner = due_good_ && !listed_now_ && f.partner == leaving ? leaving : nobody;
      f = {{0.0, d.x[i], d.y[i], d.vx[i], d.vy[i]}, d.radius_of(i), d.id[i], partner, 0, 0};
      // A little early, for the rounding of paths that begin afresh.
      field_.due[i] = due_good_ ? (field_.due[i] - last_length_) - early_share * last_length_ : 0.0;
      if (listed_now_ && due_good_) {
        const double exit = lists_.exit_time(static_cast<std::uint32_t>(i), f.path, 0.0, plan.length, g);
        field_.due[i] = std::min(field_.due[i], exit);
      }
      if (tc) field_.last_contact[i] = state_.last_contact[d.id[i]] - plan.start;
      if (may_collapse) field_.burst[i] = {};
    }
  });
}

// Runs the window, again where somebody was too fast or where it is crowded, which shortens it. False: given up; the
// state is as it was.
bool ParallelExact::run_window_surely(WindowPlan& plan) {
  double allowed = allowed_speed;
  int tries = 0;
  SliceEnd end = run_window(plan, allowed);
  for (; end == SliceEnd::too_fast || end == SliceEnd::crowded; end = run_window(plan, allowed)) {
    lists_good_ = due_good_ = false;
    if (end == SliceEnd::crowded) {
      // Only without tiles events come in canonical order, and tell at which of them it was too much.
      if (!sweep_.has_tiles(state_.disks.size())) plan = shortened(plan, field_.rules, sweep_.crowding());
      sweep_.allow_tiles(false);
      continue;
    }
    if (tries++ == most_tries) {
      throw PhysicsError("exact: no way through the window at t = " + std::to_string(plan.start));
    }
    if (tries == most_tries) sweep_.allow_tiles(false);
    allowed *= 2.0 * allowed_speed;
  }
  if (end == SliceEnd::given_up) lists_good_ = due_good_ = false;
  if (!sweep_.tiles_allowed()) lists_good_ = false;
  sweep_.allow_tiles(true);
  return end == SliceEnd::done;
}

// Unless it is done, the state is as it was. allowed: a factor on the largest speed at the window's start.
SliceEnd ParallelExact::run_window(const WindowPlan& plan, double allowed) {
  list_if_due();
  load_paths(plan);
  const PhaseTimer timer(times_, "events");
  sweep_.begin_window(listed_now_);
  listed_now_ = false;
  const bool tiled = sweep_.has_tiles(state_.disks.size());
  const double fall = field_.rules.gravity * plan.length;
  const double fastest = allowed * std::sqrt(field_.fastest2) + fall;
  field_.allowed2 = tiled ? fastest * fastest : HUGE_VAL;
  field_.bound = fastest + fall;
  Count before = 0;
  for (double start = 0.0; start < plan.length;) {
    const double end = slice_end(plan, start);
    const double elapsed = std::min(end, plan.length) - start;
    const double expected = std::min(rate_ * elapsed, 4.0 * static_cast<double>(state_.disks.size()));
    const SliceEnd reached = sweep_.run(start, end, expected, plan.start);
    if (reached != SliceEnd::done) return reached;
    rate_ = static_cast<double>(sweep_.events() - before) / elapsed;
    before = sweep_.events();
    start = end;
  }
  return SliceEnd::done;
}

// Slices of a window are alike.
double ParallelExact::slice_end(const WindowPlan& plan, double start) const {
  const double n = static_cast<double>(state_.disks.size());
  double longest = sweep_.longest_slice();
  if (longest < never && rate_ > 0.0) longest = std::min(longest, events_per_slice * n / rate_);
  const double left = plan.length - start;
  const double parts = std::ceil(left / longest);
  return parts > 1.0 ? start + left / parts : never;
}

void ParallelExact::store_paths(const WindowPlan& plan) {
  const PhaseTimer timer(times_, "store");
  Disks& d = state_.disks;
  const std::size_t n = d.size();
  const bool any_gone = sweep_.any_gone();
  gone_.assign(any_gone ? n : 0, 0);
  executor_.for_ranges(n, pass_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      PathSegment p = carried_to(field_.flight[i].path, plan.length, field_.rules.gravity);
      if (any_gone && std::isnan(p.x)) {
        gone_[i] = 1;
      } else {
        wrap_into(p, scene_.box);
      }
      d.x[i] = p.x;
      d.y[i] = p.y;
      d.vx[i] = p.vx;
      d.vy[i] = p.vy;
      if (!state_.last_contact.empty()) state_.last_contact[d.id[i]] = plan.start + field_.last_contact[i];
    }
  });
  at_start_ = any_gone ? d : Disks{};
  due_good_ = true;
  last_length_ = plan.length;
  last_plan_ = plan;
  has_paths_ = true;
  if (any_gone) remove(gone_);
  const ImpactTally tally = sweep_.tally();
  finish_window(state_, plan, tally, 1.0);
  validity_.see_step(scene_, {{}, {}, {}, tally.inaccurate}, state_);
}

double ParallelExact::disks_at(double t, Disks& out) const {
  if (!(t < state_.time) || !field_.keeps_paths || !has_paths_) {
    out = state_.disks;
    return state_.time;
  }
  const double s = t > last_plan_.start ? t - last_plan_.start : 0.0;
  out = sweep_.any_gone() ? at_start_ : state_.disks;
  // The piece that is last of those begun by s; a block's log has a disk's pieces in order.
  std::vector<PathSegment> path(field_.flight.size());
  for (std::size_t i = 0; i < path.size(); ++i) path[i] = field_.flight[i].path;
  std::vector<unsigned char> gone(path.size(), 0);
  std::vector<unsigned char> logged(path.size(), 0);
  const auto read = [&](const std::vector<LoggedPiece>& log) {
    for (const LoggedPiece& piece : log) {
      if (piece.path.start > s || (logged[piece.disk] != 0 && piece.path.start < path[piece.disk].start)) continue;
      path[piece.disk] = piece.path;
      gone[piece.disk] = piece.gone ? 1 : 0;
      logged[piece.disk] = 1;
    }
  };
  sweep_.read_logs(read);
  for (std::size_t i = 0; i < path.size(); ++i) {
    PathSegment p = carried_to(path[i], s, scene_.physics.gravity);
    wrap_into(p, scene_.box);
    out.x[i] = p.x;
    out.y[i] = p.y;
    out.vx[i] = p.vx;
    out.vy[i] = p.vy;
  }
  remove_marked(out, gone);
  return t;
}

}  // namespace

std::unique_ptr<Engine> make_parallel_exact(const Scene& scene, State initial, const Threads& threads) {
  return std::make_unique<ParallelExact>(scene, std::move(initial), threads);
}

}  // namespace carom
