#include "parallel/exact/window_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.hpp"
#include "core/physics/exact_path.hpp"
#include "parallel/exact/logged_paths.hpp"

namespace carom {

namespace {

// Disks a block in passes over all disks.
constexpr std::size_t pass_block = 8192;
// At the start of a window all paths begin anew from rounded coordinates, so that events may come a little earlier than
// predicted. So disks are predicted again this share of a window earlier. That is enough for contacts with an approach
// faster than WindowState::slow; slower ones that are close are predicted at the start of every window.
constexpr double early_share = 1e-3;
// Of a window that is cut shorter than this share of what it is meant to last, as if it lasted so long.
constexpr double least_length_share = 1.0 / 32.0;
// Windows of less than half the longest's length. Of longer ones there are eight at most up to the horizon.
constexpr int most_short_windows = most_windows_predicted - 8;
// A disk is listed as far ahead of where it is as it flies in this many of its mean free times; after a collision, two
// fifths of its velocity remain on average. The fewest instructions a collision are at 0.5 to 1, at packing fractions
// of 0.2 and 0.5.
constexpr double lead_in_free_times = 0.7;

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
      scheduler_(window_, lists_, executor_),
      predicts_anew_(scene.box.has_sine_side()) {}

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
  // Times that are known stay valid: two disks that did not list each other cannot touch before one of them reaches its
  // next event, which is at the latest that of being relisted. In a sheared box that holds until the lists are
  // strained, and events are predicted further ahead.
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

void WindowRun::set_part(const PartEnds& ends, std::size_t own, double largest_radius, State& all,
                         const std::vector<std::uint32_t>& slots,
                         const std::function<DiskProgress(std::uint32_t)>& mark) {
  all_ = &all;
  slots_ = &slots;
  window_.is_part = true;
  window_.part = ends;
  window_.part_is_known = true;
  own_ = own;
  least_largest_radius_ = largest_radius;
  largest_radius_ = std::max(largest_radius, largest_radius_);
  mark_ = mark;
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
  if (!window_.part.note_listing(lists_.listed_position(i), lists_.skin() + window_.slack, window_.record[i]))
    window_.part_is_known = false;
}

// Of a part whose lists have just been built.
void WindowRun::mark_disks() {
  for (std::uint32_t i = 0; i < window_.record.size(); ++i) {
    window_.record[i].progress = mark_(i);
    note_listing(i);
  }
}

// order: for each disk, which one it was before.
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

// From now on lists and times are on their way to the window's end: if it fails, they are not valid.
void WindowRun::begin(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks, double margin) {
  if (scene_.box.shear.acts()) lists_.carry_flow(box_at(scene_.box, plan.start), plan.start);
  if (scene_.box.inner_walls_move && !rebuilt_) lists_.see_where_walls_move(state_.disks, executor_);
  count_window(plan);
  load_paths(plan, speeds, disks);
  known_at_end_ = std::exchange(known_, Known::nothing);
  set_speed_bound(plan, margin);
  const PhaseTimer timer(times_, "events");
  scheduler_.begin_window(rebuilt_, per_disk_);
  if (rebuilt_ && mark_) mark_disks();
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

void WindowRun::load_paths(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks) {
  const PhaseTimer timer(times_, "load");
  const Disks& d = state_.disks;
  window_.begin(exact_rules(scene_, d, plan.start), d, plan, speeds.largest2, largest_radius_);
  window_.most_paths = most_paths(disks);
  // Each event is a collision of two disks. While the rate is not known, a disk is listed where it is.
  lists_.set_lead_time(per_disk_ > 0.0 ? lead_in_free_times / (2.0 * per_disk_) : 0.0);
  if (slots_ != nullptr) {
    for (std::size_t i = 0; i < window_.spin.size(); ++i) window_.spin[i] = all_->disks.spin[(*slots_)[i]];
  }
  window_.safe_speed2 = lists_.safe_speed2(plan.length, window_.rules.gravity.size);
  window_.last_contact.resize(all_->last_contact.empty() ? 0 : d.size());
  window_.thermal_hits.resize(all_->thermal_hits.empty() ? 0 : d.size());
  executor_.for_ranges(d.size(), pass_block,
                       [&](std::size_t, std::size_t begin, std::size_t end) { load_disks(begin, end, plan); });
}

void WindowRun::load_disks(std::size_t begin, std::size_t end, const WindowPlan& plan) {
  const Disks& d = state_.disks;
  const bool timed = known_ == Known::lists_and_times;
  const bool relists_stay = timed && !rebuilt_;
  // Pointers to the columns in registers: stores to records and entries could change them otherwise.
  const Disks& paths = all_->disks;
  const double* const x = paths.x.data();
  const double* const y = paths.y.data();
  const double* const vx = paths.vx.data();
  const double* const vy = paths.vy.data();
  const DiskId* const id = d.id.data();
  DiskRecord* const record = window_.record.data();
  CalendarEntry* const entry = window_.entry.data();
  const double length = length_;
  const double early = early_share * std::max(length, least_length_share * meant_);
  const auto load = [&](const auto& slot_of) __attribute__((always_inline)) {
    for (std::size_t i = begin; i < end; ++i) {
      // A contact is predicted again, since rounding at the start of paths may make another event the first.
      const bool relists = relists_stay && record[i].partner.is_relist();
      const std::size_t k = slot_of(i);
      record[i].path = {0.0, x[k], y[k], vx[k], vy[k]};
      record[i].radius = d.common_radius;
      record[i].id = id[i];
      record[i].partner = relists ? Partner::relist() : Partner::none();
      record[i].version = record[i].partner_version = 0;
      // The time of the event that was predicted in the window before, from the new start, and a little earlier.
      entry[i].time = (entry[i].time - length) - early;
    }
  };
  if (slots_ != nullptr) {
    load([slot = slots_->data()](std::size_t i) { return std::size_t{slot[i]}; });
  } else {
    load([](std::size_t i) { return i; });
  }
  if (!d.radius.empty()) {
    for (std::size_t i = begin; i < end; ++i) record[i].radius = d.radius[i];
  }
  if (!timed || predicts_anew_) {
    for (std::size_t i = begin; i < end; ++i) entry[i].time = 0.0;
  } else if (rebuilt_) {
    const double valid = (known_until_ - plan.start) - early;
    for (std::size_t i = begin; i < end; ++i) {
      entry[i].time = std::min({entry[i].time, first_relist_time(i, plan), valid});
    }
  }
  if (scene_.box.obstacles != nullptr) {
    for (std::size_t i = begin; i < end; ++i) {
      if (lists_.is_obstacle_near(static_cast<std::uint32_t>(i))) entry[i].time = 0.0;
    }
  }
  if (!window_.last_contact.empty()) {
    for (std::size_t i = begin; i < end; ++i) window_.last_contact[i] = all_->last_contact[d.id[i]] - plan.start;
  }
  if (!window_.thermal_hits.empty()) {
    for (std::size_t i = begin; i < end; ++i) window_.thermal_hits[i] = all_->thermal_hits[d.id[i]];
  }
  if (!window_.burst.empty()) std::fill_n(&window_.burst[begin], end - begin, Burst{});
}

// Which disks are near borders is not known yet when lists have just been built: all are taken to be.
double WindowRun::first_relist_time(std::size_t i, const WindowPlan& plan) const {
  return lists_.earliest_relist_time(static_cast<std::uint32_t>(i), window_.record[i].path, 0.0, plan.length,
                                     window_.rules.gravity, lists_.relist_distance(true));
}

void WindowRun::set_speed_bound(const WindowPlan& plan, double margin) {
  const double fall = window_.rules.gravity.size * plan.length;
  const double fastest = margin * std::sqrt(window_.fastest2) + fall;
  window_.speed_limit2 = window_.mode == EngineMode::regions ? fastest * fastest : HUGE_VAL;
  window_.speed_bound = fastest + fall;
}

// Disks [begin, end), where neither gravity nor a shear acts: what store_paths does there. The place of a disk that is
// gone is not a number, and stays so.
void WindowRun::store_straight(std::size_t begin, std::size_t end, double length) {
  Disks& d = state_.disks;
  const Domain& box = window_.rules.box;
  double* const x = d.x.data();
  double* const y = d.y.data();
  double* const vx = d.vx.data();
  double* const vy = d.vy.data();
  const DiskRecord* const record = window_.record.data();
  const double width = box.periodic_x() ? box.width : HUGE_VAL;
  const double height = box.periodic_y() ? box.height : HUGE_VAL;
  const double left = box.periodic_x() ? 0.0 : -HUGE_VAL;
  const double bottom = box.periodic_y() ? 0.0 : -HUGE_VAL;
  for (std::size_t i = begin; i < end; ++i) {
    const PathSegment& p = record[i].path;
    const double s = length - p.start;
    double px = p.x;
    double py = p.y;
    if (p.start != length) [[likely]] {
      px += p.vx * s;
      py += p.vy * s;
    }
    if (px < left || px >= width) [[unlikely]]
      px = box.periodic_x() ? wrap(px, width) : px;
    if (py < bottom || py >= height) [[unlikely]]
      py = box.periodic_y() ? wrap(py, height) : py;
    x[i] = px;
    y[i] = py;
    vx[i] = p.vx;
    vy[i] = p.vy;
  }
}

ImpactTally WindowRun::store_paths(const WindowPlan& plan, std::vector<unsigned char>& gone) {
  const PhaseTimer timer(times_, "store");
  if (slots_ != nullptr) return store_part(plan);
  Disks& d = state_.disks;
  const std::size_t n = d.size();
  const bool any_gone = scheduler_.any_gone();
  gone.assign(any_gone ? n : 0, 0);
  const Domain& box = window_.rules.box;
  std::vector<ImpactTally> crossings(box.shear.acts() ? executor_.blocks(n, pass_block) : 0);
  const bool straight = !window_.rules.gravity.acts() && !box.shear.acts();
  const auto store = [&](const auto& wrap_path) {
    executor_.for_ranges(n, pass_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      if (straight) store_straight(begin, end, plan.length);
      for (std::size_t i = straight ? end : begin; i < end; ++i) {
        PathSegment p = carried_to(window_.record[i].path, plan.length, window_.rules.gravity);
        if (!any_gone || !std::isnan(p.x)) wrap_path(p, i, b);
        put(p, d, i);
      }
      for (std::size_t i = begin; any_gone && i < end; ++i) gone[i] = std::isnan(d.x[i]) ? 1 : 0;
      if (!all_->last_contact.empty()) {
        for (std::size_t i = begin; i < end; ++i) {
          all_->last_contact[d.id[i]] = plan.start + window_.last_contact[i];
        }
      }
      if (!all_->thermal_hits.empty()) {
        for (std::size_t i = begin; i < end; ++i) {
          all_->thermal_hits[d.id[i]] = window_.thermal_hits[i];
        }
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
  return end_window(plan, crossings);
}

ImpactTally WindowRun::end_window(const WindowPlan& plan, const std::vector<ImpactTally>& crossings) {
  if (known_ == Known::lists) known_ = Known::lists_and_times;
  length_ = plan.length;
  meant_ = window_.meant;
  ImpactTally tally = scheduler_.tally();
  for (const ImpactTally& block : crossings) tally.add(block);
  return tally;
}

// Own disks alone, to the columns of all.
ImpactTally WindowRun::store_part(const WindowPlan& plan) {
  Disks& to = all_->disks;
  const std::uint32_t* const slot = slots_->data();
  for (std::size_t i = 0; i < window_.record.size(); ++i) {
    const DiskRecord& record = window_.record[i];
    if (record.progress.has(DiskProgress::ghost)) continue;
    PathSegment p = carried_to(record.path, plan.length, window_.rules.gravity);
    wrap_into(p, window_.rules.box);
    put(p, to, slot[i]);
    if (!window_.spin.empty()) to.spin[slot[i]] = window_.spin[i];
    if (!window_.last_contact.empty()) all_->last_contact[record.id] = plan.start + window_.last_contact[i];
    if (!window_.thermal_hits.empty()) all_->thermal_hits[record.id] = window_.thermal_hits[i];
  }
  return end_window(plan, {});
}

}  // namespace carom
