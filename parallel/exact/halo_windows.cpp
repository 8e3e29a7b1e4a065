#include "parallel/exact/halo_windows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/disks/disks.hpp"
#include "core/step/step_start.hpp"
#include "core/step/window_length.hpp"
#include "parallel/exact/logged_paths.hpp"

namespace carom {

namespace {

// With fewer disks one thread is as fast.
constexpr std::size_t least_disks = 4000;
// A thread with more disks than most_disks has several parts of about disks_of_several each, one after the other: then
// the data of a slice of a part come from nearer caches and from fewer pages. Several parts are faster from 4 10^5
// disks on, by a sixth at 10^6, but take a quarter more memory.
// quarter more memory.
constexpr std::size_t most_disks = 1'000'000;
constexpr std::size_t disks_of_several = 125'000;
// The number of disks of such a part if threads share that cache.
constexpr std::size_t disks_of_shared = 64'000;
// The least width of a part, in halos.
constexpr double least_width = 2.0;
// If there are more parts than threads: the most disks of all parts together, ghosts included, over the number of disks
// in the box; less for very many disks, since ghosts take memory.
constexpr double most_with_ghosts = 1.16;
constexpr double most_with_ghosts_of_many = 1.05;
constexpr std::size_t very_many = 50'000'000;
// The box is cut into strips if a part would otherwise have fewer disks than the mean number over this.
constexpr std::size_t least_share = 8;
// How often a window is run in parts, each time with new halos, before it is run without parts.
constexpr int most_tries = 3;
// The number of windows that are run without parts after one that could not be run in parts: more each time if that
// happens again soon.
constexpr int least_pause = 2;
constexpr int longest_pause = 64;
// The width of halos at first, in mean spacings. If work is cut into much smaller blocks, as in tests, halos are narrow
// and stay so: then even small scenes have parts, and many windows are void.
constexpr double first_width = 8.0;
constexpr std::size_t cut_small = 8;
constexpr double width_of_cut_work = 4.0;

// Returns a function that says whether the part owns a disk.
std::function<bool(std::uint32_t)> owned_by(const HaloPart& part) {
  return [&part](std::uint32_t i) { return !part.run().window().record[i].progress.has(DiskProgress::ghost); };
}

}  // namespace

HaloWindows::HaloWindows(const Scene& scene, State& state, const Executor& executor, PhaseTimes& times)
    : scene_(scene),
      state_(state),
      executor_(executor),
      times_(times),
      pause_(least_pause),
      tuning_(work_is_cut() ? width_of_cut_work : first_width, !work_is_cut()) {}

bool HaloWindows::work_is_cut() const {
  return executor_.grain(least_disks) < least_disks / cut_small;
}

// The mean distance of disks; at least a diameter, in case the disks fill only a part of the box.
double HaloWindows::mean_spacing() const {
  const double n = static_cast<double>(state_.disks.size());
  return std::max(std::sqrt(scene_.box.width * scene_.box.height / n), 2.0 * largest_radius(state_.disks));
}

// One part for each thread, or the same number of parts for each. If work is cut into smaller blocks, as in tests,
// there are several parts on one thread, too.
PieceCounts HaloWindows::pieces(Cuts cuts) const {
  const auto threads = static_cast<std::size_t>(executor_.threads());
  const std::size_t n = state_.disks.size();
  const double halo = tuning_.spacings() * spacing_;
  const double most_share = n > very_many ? most_with_ghosts_of_many : most_with_ghosts;
  const bool is_much = executor_.blocks(n, most_disks) > threads;
  const std::size_t wanted = executor_.blocks(n, threads == 1 ? disks_of_several : disks_of_shared);
  for (std::size_t each = is_much ? wanted / threads : 1; each > 1; --each) {
    const PieceCounts pieces = pieces_of(threads * each, cuts);
    const bool is_ample = work_is_cut() || share_with_ghosts(pieces, scene_.box, halo) < most_share;
    if (pieces.parts() > 1 && is_ample) return pieces;
  }
  const bool is_cut = executor_.grain(least_disks) < least_disks;
  for (std::size_t parts = std::max<std::size_t>(threads, is_cut ? 2 : 1); parts > 1; --parts) {
    const PieceCounts pieces = pieces_of(parts, cuts);
    if (pieces.parts() > 1) return pieces;
  }
  return {};
}

// A single part if there is no room for this number.
PieceCounts HaloWindows::pieces_of(std::size_t parts, Cuts cuts) const {
  const double halo = tuning_.spacings() * spacing_;
  const Domain& box = scene_.box;
  if (cuts == Cuts::along_both_axes) return best_pieces(parts, box, halo, least_width);
  const bool wide = box.width > box.height;
  const bool fit = static_cast<double>(parts) * least_width * halo <= std::max(box.width, box.height);
  return !fit ? PieceCounts{} : wide ? PieceCounts{parts, 1} : PieceCounts{1, parts};
}

// Windows are not run in parts if there are sources or sinks, if disks cannot be listed with a skin, or in a sheared
// box, whose images move.
bool HaloWindows::are_wanted() {
  if (windows_without_ > 0) {
    --windows_without_;
    return false;
  }
  if (known_ == Known::nothing) spacing_ = mean_spacing();
  const bool keeps_disks = scene_.sources.empty() && !has_sinks(scene_);
  return keeps_disks && !scene_.box.shear.acts() && can_list_in(scene_.box) &&
         state_.disks.size() >= executor_.grain(least_disks) && pieces(Cuts::along_both_axes).parts() > 1;
}

void HaloWindows::forget(Known left) {
  known_ = std::min(known_, left);
  for (const std::unique_ptr<HaloPart>& part : parts_) part->run().forget(left);
}

void HaloWindows::release_memory() {
  parts_.clear();
  work_ = {};
  known_ = Known::nothing;
}

bool HaloWindows::lists_due(const WindowPlan& plan) const {
  const auto is_due = [&](const auto& part) { return part->run().lists_due(plan); };
  return known_ == Known::nothing || tuning_.is_too_narrow() || std::any_of(parts_.begin(), parts_.end(), is_due);
}

void HaloWindows::build(const WindowPlan& plan) {
  const PhaseTimer timer(times_, "list");
  tuning_.adapt();
  // Loading and storing a disk's path is counted as one event.
  for (std::size_t r = 0; r < parts_.size() && r < work_.work.size(); ++r) {
    work_.work[r] = work_.work[r] / static_cast<double>(std::max<std::size_t>(parts_[r]->own(), 1)) + 1.0;
  }
  std::vector<DisksOfPart> disks = share_out();
  build_parts(plan, work_.cut, std::move(disks));
  known_ = Known::lists;
}

// If disks crowd, lines across the whole box may leave hardly any disks in some parts: then the box is cut into strips.
std::vector<DisksOfPart> HaloWindows::share_out() {
  const std::size_t n = state_.disks.size();
  const auto cut_into = [&](PieceCounts pieces) {
    return cut_box(state_.disks, scene_.box, pieces, tuning_.spacings() * spacing_, work_);
  };
  BoxCut cut = cut_into(pieces(Cuts::along_both_axes));
  std::vector<DisksOfPart> disks = disks_of_parts(state_.disks, cut, executor_);
  const auto least = std::min_element(disks.begin(), disks.end(),
                                      [](const DisksOfPart& a, const DisksOfPart& b) { return a.own < b.own; });
  if (cut.x.pieces() > 1 && cut.y.pieces() > 1 && least->own * cut.parts() * least_share < n) {
    cut = cut_into(pieces(Cuts::along_longer_side));
    disks = disks_of_parts(state_.disks, cut, executor_);
  }
  work_ = {cut, std::vector<double>(cut.parts(), 0.0)};
  return disks;
}

// Afterwards the columns of all disks are in the order of the parts.
void HaloWindows::build_parts(const WindowPlan& plan, const BoxCut& cut, std::vector<DisksOfPart>&& disks) {
  parts_.resize(cut.parts());
  for (std::unique_ptr<HaloPart>& part : parts_) {
    if (!part) part = std::make_unique<HaloPart>(scene_);
  }
  for_parts([&](HaloPart& part) { part.release_windows(state_.disks); });
  std::vector<std::uint32_t> slots(state_.disks.size());
  executor_.run(parts_.size(),
                [&](std::size_t r) { parts_[r]->take_disks(state_.disks, cut, r, std::move(disks[r])); });
  std::vector<std::size_t> firsts{0};
  for (const std::unique_ptr<HaloPart>& part : parts_) firsts.push_back(firsts.back() + part->own());
  const LargestRadius radii{largest_radius(state_.disks), growth_};
  executor_.run(parts_.size(), [&](std::size_t r) { parts_[r]->build(plan, cut, state_, radii, firsts[r], slots); });
  for_parts([&](HaloPart& part) {
    part.find_owners(firsts, slots);
    part.give_columns(state_.disks);
  });
}

SliceOutcome HaloWindows::run(const WindowPlan& plan, const SpeedSummary& speeds, const WindowState& window) {
  SliceOutcome outcome = SliceOutcome::ghosts_too_few;
  for (int tries = 0; tries < most_tries && outcome == SliceOutcome::ghosts_too_few; ++tries) {
    if (!lists_due(plan)) exchange_disks();
    if (lists_due(plan)) {
      spacing_ = mean_spacing();
      build(plan);
    }
    if (parts_.size() < 2) break;
    begin(plan, speeds, window);
    outcome = run_slices(plan);
    if (outcome != SliceOutcome::ghosts_too_few) continue;
    tuning_.see_void();
    ++void_runs_;
  }
  if (outcome == SliceOutcome::done) {
    tuning_.see_window(use_);
    known_ = Known::lists_and_times;
    pause_ = std::max(least_pause, pause_ - 1);
  } else if (outcome != SliceOutcome::given_up) {
    windows_without_ = pause_;
    pause_ = std::min(longest_pause, 2 * pause_);
  }
  return outcome;
}

// Exchanges the disks that have come near to another part, or into one, since the last window; disks that are exchanged
// already are no longer offered.
void HaloWindows::exchange_disks() {
  for_parts([&](HaloPart& part) { part.take_offers(state_.disks, parts_); });
  for (const std::unique_ptr<HaloPart>& part : parts_) part->clear_offers();
  for (const std::unique_ptr<HaloPart>& part : parts_) part->take_over(parts_);
}

void HaloWindows::take_radii() {
  for_parts([&](HaloPart& part) { part.take_radii(state_.disks); });
}

double HaloWindows::growth() const {
  double least = HUGE_VAL;
  for (const std::unique_ptr<HaloPart>& part : parts_) least = std::min(least, part->run().lists().growth());
  return least;
}

bool HaloWindows::complete_lists() {
  exchange_disks();
  std::vector<unsigned char> has_all(parts_.size());
  executor_.run(parts_.size(), [&](std::size_t r) {
    const HaloPart& part = *parts_[r];
    has_all[r] = part.run().known() != Known::nothing && part.has_all_near_own(state_.disks) ? 1 : 0;
  });
  return std::find(has_all.begin(), has_all.end(), 0) == has_all.end();
}

void HaloWindows::visit_lists(const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const {
  for_parts([&](const HaloPart& part) { part.visit_lists(visit); });
}

void HaloWindows::begin(const WindowPlan& plan, const SpeedSummary& speeds, const WindowState& window) {
  known_ = Known::nothing;
  use_ = {};
  for_parts([&](HaloPart& part) {
    WindowState& own = part.run().window();
    own.keeps_paths = window.keeps_paths;
    own.go_on = window.go_on;
    part.begin_window();
    part.run().begin(plan, speeds, state_.disks.size(), 1.0);
  });
}

SliceOutcome HaloWindows::run_slices(const WindowPlan& plan) {
  const PhaseTimer timer(times_, "events");
  const int slices = tuning_.slices();
  for (int k = 0; k < slices; ++k) {
    const auto end_of = [&](int slice) { return plan.length * slice / slices; };
    const SliceOutcome outcome = run_slice(plan, end_of(k), k + 1 < slices ? end_of(k + 1) : never);
    if (outcome != SliceOutcome::done) return outcome;
  }
  for (const std::unique_ptr<HaloPart>& part : parts_) part->run().finish_slices();
  return SliceOutcome::done;
}

// A part ends the slice with too_fast if one of its own disks came to a part that does not have it as a ghost.
SliceOutcome HaloWindows::run_slice(const WindowPlan& plan, double start, double end) {
  std::vector<SliceOutcome> outcome(parts_.size());
  executor_.run(parts_.size(),
                [&](std::size_t r) { outcome[r] = parts_[r]->run().run_slice(plan, state_.disks.size(), start, end); });
  const auto any = [&](SliceOutcome o) { return std::find(outcome.begin(), outcome.end(), o) != outcome.end(); };
  for (const SliceOutcome o : {SliceOutcome::given_up, SliceOutcome::crowded}) {
    if (any(o)) return o;
  }
  if (any(SliceOutcome::too_fast)) return SliceOutcome::ghosts_too_few;
  for_parts([&](HaloPart& part) { part.compare_with(parts_); });
  bool agree = true;
  for (const std::unique_ptr<HaloPart>& part : parts_) {
    agree = agree && part->agrees();
    use_.see({part->use().nearest / spacing_, part->use().deepest / spacing_});
  }
  if (!agree) return SliceOutcome::ghosts_too_few;
  return is_crowded() ? SliceOutcome::crowded : SliceOutcome::done;
}

// Paths are counted for all parts together, as with a single queue.
bool HaloWindows::is_crowded() const {
  Count paths = 0;
  for (const std::unique_ptr<HaloPart>& part : parts_) paths += part->run().scheduler().segments();
  return paths > most_paths(state_.disks.size());
}

void HaloWindows::add_work() {
  for (std::size_t r = 0; r < parts_.size(); ++r)
    work_.work[r] += static_cast<double>(parts_[r]->run().scheduler().events());
}

ImpactTally HaloWindows::store_paths(const WindowPlan& plan) {
  const PhaseTimer timer(times_, "store");
  std::vector<ImpactTally> tally(parts_.size());
  executor_.run(parts_.size(), [&](std::size_t r) {
    std::vector<unsigned char> gone;
    tally[r] = parts_[r]->run().store_paths(plan, gone);
    parts_[r]->find_offers(state_.disks);
  });
  add_work();
  for (std::size_t r = 1; r < tally.size(); ++r) tally[0].add(tally[r]);
  return tally[0];
}

void HaloWindows::change_velocities(std::span<const std::uint32_t> disks) {
  std::vector<unsigned char> changed(state_.disks.size(), 0);
  for (const std::uint32_t i : disks) changed[i] = 1;
  for_parts([&](HaloPart& part) { part.change_velocities(changed); });
}

// All parts are asked, since an own disk may have left its part.
void HaloWindows::visit_near(Vec2 centre, double half_width, double half_height,
                             const std::function<void(std::size_t)>& visit) const {
  for (const std::unique_ptr<HaloPart>& part : parts_) part->visit_near(centre, half_width, half_height, visit);
}

void HaloWindows::move_along_paths(double s, Disks& disks) const {
  for (const std::unique_ptr<HaloPart>& part : parts_) {
    const WindowRun& run = part->run();
    Disks moved;
    moved.id = part->ids();
    for (std::vector<double>* column : {&moved.x, &moved.y, &moved.vx, &moved.vy}) column->resize(part->size());
    moved.spin = run.window().spin;
    carom::move_along_paths(run.window(), run.scheduler(), s, run.window().rules.box, {}, moved);
    part->give_paths(moved, disks);
  }
}

std::vector<DiskContact> HaloWindows::contacts(double start) const {
  std::vector<DiskContact> all;
  for (const std::unique_ptr<HaloPart>& part : parts_) {
    const std::vector<DiskContact> own =
        contacts_of_window(part->run().scheduler(), part->ids(), start, owned_by(*part));
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

double HaloWindows::fastest_within() const {
  double fastest = 0.0;
  for (const std::unique_ptr<HaloPart>& part : parts_) {
    fastest = std::max(fastest, fastest_of_window(part->run().scheduler(), owned_by(*part)));
  }
  return fastest;
}

}  // namespace carom
