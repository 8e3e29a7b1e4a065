#include "parallel/exact/window_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.hpp"

namespace carom {

namespace {

// The number of windows of less than half the longest's length. Of longer ones there are at most eight up to the
// horizon.
constexpr int most_short_windows = most_windows_predicted - 8;

}  // namespace

void fail_speed_bound(const WindowPlan& plan) {
  throw PhysicsError(fmt::format("exact: the speed bound failed after {} retries, at t = {}; please report this scene",
                                 most_retries, plan.start));
}

WindowRun::WindowRun(const Scene& scene, State& state, const Executor& executor, PhaseTimes& times)
    : scene_(scene),
      state_(state),
      all_(&state),
      executor_(executor),
      times_(times),
      scheduler_(window_, lists_, executor_) {}

void WindowRun::set_ghosts(WindowGhosts* ghosts, double largest_radius) {
  ghosts_ = ghosts;
  least_largest_radius_ = largest_radius;
  scheduler_.set_ghosts(ghosts);
}

void WindowRun::release_memory() {
  window_.release_memory();
  scheduler_.release_calendars();
  lists_ = NeighbourLists();
  known_ = Known::nothing;
}

void WindowRun::forget_lists() {
  known_ = Known::nothing;
  if (state_.disks.size() <= disks_of_much_memory) return;
  scheduler_.release_calendars();
  lists_.release_rows();
}

bool WindowRun::lists_due(const WindowPlan& plan) const {
  const bool strained = scene_.box.shear.acts() && lists_.is_strained(plan.end);
  return known_ == Known::nothing || strained || relistings() > relistings_a_disk || are_outgrown();
}

bool WindowRun::are_outgrown() const {
  if (window_.mode != EngineMode::single_queue || window_.is_part) return false;
  const auto now = static_cast<double>(state_.disks.size());
  const auto before = static_cast<double>(disks_when_built_);
  return now > most_growth * before || most_growth * now < before;
}

double WindowRun::relistings() const {
  const std::size_t disks = state_.disks.size();
  return disks == 0 ? 0.0 : static_cast<double>(scheduler_.relisted()) / static_cast<double>(disks);
}

void WindowRun::build_lists(const WindowPlan& plan, const ListLayout& layout, const NeighbourLists::Sorted& sorted) {
  const PhaseTimer timer(times_, "list");
  // Sorting takes about as much memory.
  if (std::max(state_.disks.size(), layout.disks_of_box) > disks_of_much_memory) scheduler_.release_calendars();
  // Known times stay valid: two disks that did not list each other cannot touch before one of them reaches its next
  // event, which is relisting at the latest. In a sheared box that is true until the lists are strained, and events are
  // predicted further ahead than that.
  known_until_ = lists_.strained_at();
  lists_.follow_flow(box_at(scene_.box, plan.start), plan.start, plan.length);
  const bool timed = known_ == Known::lists_and_times;
  lists_.build(state_.disks, scene_.box, layout, executor_, [&](const auto& order, auto& scratch) {
    if (timed) sort_times(order, scratch);
    if (sorted) sorted(order, scratch);
  });
  window_.mode = layout.mode;
  window_.regions = layout.regions;
  window_.looks_ahead = layout.looks_ahead;
  largest_radius_ = std::max(least_largest_radius_, carom::largest_radius(state_.disks) + layout.growth);
  known_ = std::max(known_, Known::lists);
  rebuilt_ = true;
  disks_when_built_ = state_.disks.size();
}

void WindowRun::set_part(const PartEnds& ends, const std::vector<std::uint32_t>& own, double largest_radius, State& all,
                         const std::vector<std::uint32_t>& slots) {
  all_ = &all;
  slots_ = &slots;
  window_.is_part = true;
  window_.part = ends;
  window_.part_is_known = true;
  own_disks_ = &own;
  least_largest_radius_ = largest_radius;
  largest_radius_ = std::max(largest_radius, largest_radius_);
}

void WindowRun::append_last_disk(Vec2 at) {
  window_.append_disk(0.0);
  lists_.append(state_.disks, static_cast<std::uint32_t>(state_.disks.size() - 1), at);
}

bool WindowRun::takes_changes() const {
  return known_ != Known::nothing && window_.mode == EngineMode::single_queue && !scene_.box.shear.acts() &&
         state_.disks.size() > all_pairs_up_to;
}

void WindowRun::append_disks(std::size_t first) {
  const Disks& d = state_.disks;
  for (std::size_t i = first; i < d.size(); ++i) {
    window_.append_disk(length_);
    lists_.append(d, static_cast<std::uint32_t>(i), {d.x[i], d.y[i]});
  }
}

void WindowRun::remove_disk(std::size_t i, const Disks& disks) {
  lists_.remove(static_cast<std::uint32_t>(i), disks);
  window_.remove_disk(i);
}

void WindowRun::note_listing(std::uint32_t i) {
  const double distance = lists_.skin() + window_.slack;
  if (!window_.part.note_listing(lists_.listed_position(i), distance, window_.record[i], window_.others[i]))
    window_.part_is_known = false;
}

// For a part whose lists have just been built.
void WindowRun::mark_disks() {
  for (DiskRecord& record : window_.record) {
    record.progress = DiskProgress();
    record.progress.set(DiskProgress::ghost);
  }
  own_ = own_disks_->size();
  for (const std::uint32_t i : *own_disks_) {
    window_.record[i].progress = DiskProgress();
    note_listing(i);
  }
}

// order: the former index of each disk.
void WindowRun::sort_times(const std::vector<std::uint32_t>& order, std::vector<double>& scratch) {
  const auto for_blocks = [&](const auto& move) {
    executor_.for_ranges(order.size(), pass_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) move(i);
    });
  };
  for_blocks([&](std::size_t i) { scratch[i] = window_.entry[order[i]].time; });
  for_blocks([&](std::size_t i) { window_.entry[i].time = scratch[i]; });
}

SliceOutcome WindowRun::run(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks, double margin) {
  begin(plan, speeds, disks, margin);
  for (double start = 0.0; start < plan.length;) {
    const double end = scheduler_.slice_end(plan.length, start, per_disk_);
    const SliceOutcome outcome = run_slice(plan, disks, start, end);
    if (outcome != SliceOutcome::done) return outcome;
    start = end;
  }
  finish_slices();
  return SliceOutcome::done;
}

// From now on lists and times are changed as the window runs: if it fails, they are not valid.
void WindowRun::begin(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks, double margin) {
  if (scene_.box.shear.acts()) lists_.carry_flow(box_at(scene_.box, plan.start), plan.start);
  if (scene_.box.inner_walls_move && !rebuilt_) lists_.see_where_walls_move(state_.disks, executor_);
  count_window(plan);
  load_paths(plan, speeds, disks);
  known_at_end_ = std::exchange(known_, Known::nothing);
  set_speed_bound(plan, margin);
  const PhaseTimer timer(times_, "events");
  scheduler_.begin_window(rebuilt_, per_disk_);
  if (rebuilt_ && window_.is_part) mark_disks();
  rebuilt_ = false;
}

void WindowRun::count_window(const WindowPlan& plan) {
  if (short_windows_ >= most_short_windows) forget(Known::lists);
  if (known_ != Known::lists_and_times) short_windows_ = 0, longest_ = 0.0;
  longest_ = std::max(longest_, plan.meant);
  if (plan.length < 0.5 * longest_) ++short_windows_;
}

SliceOutcome WindowRun::run_slice(const WindowPlan& plan, std::size_t disks, double start, double end) {
  const PhaseTimer timer(times_, "events");
  if (!window_.part_is_known) return SliceOutcome::too_fast;
  const double elapsed = std::min(end, plan.length) - start;
  const SliceOutcome outcome = scheduler_.run(start, end, per_disk_, plan.start);
  if (outcome != SliceOutcome::done) return outcome;
  const auto events = static_cast<double>(scheduler_.events_of_slice());
  const std::size_t counted = window_.is_part ? own_ : disks;
  per_disk_ = counted == 0 ? 0.0 : events / elapsed / static_cast<double>(counted);
  return outcome;
}

void WindowRun::set_speed_bound(const WindowPlan& plan, double margin) {
  const double fall = window_.rules.gravity.size * plan.length;
  const double fastest = margin * std::sqrt(window_.fastest2) + fall;
  window_.speed_limit2 = window_.mode == EngineMode::regions ? fastest * fastest : HUGE_VAL;
  window_.speed_bound = fastest + fall;
}

}  // namespace carom
