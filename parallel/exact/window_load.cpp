// The start of a window: the paths of the disks, and the times of their next events.
#include <algorithm>

#include "parallel/exact/window_run.hpp"

namespace carom {

namespace {

// At the start of a window all paths begin anew from rounded coordinates, so events may come a little earlier than
// predicted. So disks are predicted again this share of a window earlier. That is enough for contacts with an approach
// faster than WindowState::slow; slower ones that are close are predicted at the start of every window.
constexpr double early_share = 1e-3;
// For this purpose a window counts as at least this share of the length that it is meant to have.
constexpr double least_length_share = 1.0 / 32.0;
// A disk is listed ahead of its position by its flight in this many of its mean free times; after a collision, two
// fifths of its velocity remain on average. The fewest instructions a collision are at 0.5 to 1, at packing fractions
// of 0.2 and 0.5.
constexpr double lead_in_free_times = 0.7;

}  // namespace

void WindowRun::load_paths(const WindowPlan& plan, const SpeedSummary& speeds, std::size_t disks) {
  const PhaseTimer timer(times_, "load");
  const Disks& d = state_.disks;
  window_.begin(exact_rules(scene_, d, plan.start), d, plan, speeds.largest2, largest_radius_);
  window_.most_paths = most_paths(disks);
  // Each event is a collision of two disks. As long as the rate is not known, a disk is listed at its position.
  lists_.set_lead_time(per_disk_ > 0.0 ? lead_in_free_times / (2.0 * per_disk_) : 0.0);
  if (slots_ != nullptr) {
    for (std::size_t i = 0; i < window_.spin.size(); ++i) window_.spin[i] = all_->disks.spin[(*slots_)[i]];
  }
  const double safe_before2 = window_.safe_speed2;
  window_.safe_speed2 = lists_.safe_speed2(plan.length, window_.rules.gravity.size);
  window_.last_contact.resize(all_->last_contact.empty() ? 0 : d.size());
  window_.thermal_hits.resize(all_->thermal_hits.empty() ? 0 : d.size());
  executor_.for_ranges(d.size(), pass_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    load_disks(begin, end, plan);
    if (window_.fastest2 > window_.safe_speed2) predict_far_ones(begin, end, safe_before2);
  });
}

// Loads disks [begin, end), which begin the window on new paths.
void WindowRun::load_disks(std::size_t begin, std::size_t end, const WindowPlan& plan) {
  load_records(begin, end);
  load_times(begin, end, plan);
  const Disks& d = state_.disks;
  if (!window_.last_contact.empty()) {
    for (std::size_t i = begin; i < end; ++i) window_.last_contact[i] = all_->last_contact[d.id[i]] - plan.start;
  }
  if (!window_.thermal_hits.empty()) {
    for (std::size_t i = begin; i < end; ++i) window_.thermal_hits[i] = all_->thermal_hits[d.id[i]];
  }
  if (!window_.burst.empty()) std::fill_n(&window_.burst[begin], end - begin, Burst{});
}

// Loads their records, and the times of their next events as predicted in the window before.
void WindowRun::load_records(std::size_t begin, std::size_t end) {
  const Disks& d = state_.disks;
  const Disks& paths = all_->disks;
  const BegunPaths in{.x = paths.x.data(),
                      .y = paths.y.data(),
                      .vx = paths.vx.data(),
                      .vy = paths.vy.data(),
                      .id = d.id.data(),
                      .radius = d.common_radius,
                      .record = window_.record.data(),
                      .entry = window_.entry.data(),
                      .relists_stay = known_ == Known::lists_and_times && !rebuilt_,
                      .length = length_,
                      .early = early_by()};
  if (slots_ != nullptr) {
    begin_paths_at(slots_->data(), in, begin, end);
  } else {
    path_kernels_.begin(in, begin, end);
  }
  if (d.radius.empty()) return;
  for (std::size_t i = begin; i < end; ++i) in.record[i].radius = d.radius[i];
}

// Disks whose events are not known from the window before get the time 0: they are predicted at this one's start.
void WindowRun::load_times(std::size_t begin, std::size_t end, const WindowPlan& plan) {
  CalendarEntry* const entry = window_.entry.data();
  if (known_ != Known::lists_and_times) {
    for (std::size_t i = begin; i < end; ++i) entry[i].time = 0.0;
    return;
  }
  if (rebuilt_) {
    const double valid = (known_until_ - plan.start) - early_by();
    for (std::size_t i = begin; i < end; ++i) {
      entry[i].time = std::min({entry[i].time, first_relist_time(i, plan), valid});
    }
  }
  const unsigned near = bits_of_new_sides(plan.start) | (scene_.box.obstacles != nullptr ? ListRow::obstacle_near : 0U);
  if (near == 0) return;
  for (std::size_t i = begin; i < end; ++i) {
    if ((lists_.rows().row(static_cast<std::uint32_t>(i)).sides & near) != 0) entry[i].time = 0.0;
  }
}

// The kept times of disks [begin, end) take no account of images beyond the nearest ones, or of crossing events, if the
// disk was slow enough then. In a longer window it may reach these, and is predicted anew. Disks up to safe_before2
// (v^2) were slow enough, unless they have become faster on the way.
void WindowRun::predict_far_ones(std::size_t begin, std::size_t end, double safe_before2) {
  const bool get_faster = window_.rules.gravity.size > 0.0 || window_.rules.box.shear.acts();
  for (std::size_t i = begin; i < end; ++i) {
    const PathSegment& path = window_.record[i].path;
    const double v2 = path.vx * path.vx + path.vy * path.vy;
    if (v2 > window_.safe_speed2 && (get_faster || v2 <= safe_before2)) window_.entry[i].time = 0.0;
  }
}

// Kept times come earlier by this than predicted.
double WindowRun::early_by() const {
  return early_share * std::max(length_, least_length_share * meant_);
}

// Bits (1 << side) of the sides whose contacts are predicted anew for a window that starts at this time: of sides that
// move as a sine always, since the shift of a contact by rounding depends on how it is touched; of sides that move in
// parabolas if one begins.
unsigned WindowRun::bits_of_new_sides(double start) const {
  unsigned bits = 0;
  for (const Side side : all_sides) {
    const SideMotion& motion = scene_.box.motions[static_cast<std::size_t>(side)];
    if (motion.kind == SideMotion::Kind::sine || motion.turns_at(start)) bits |= 1U << static_cast<unsigned>(side);
  }
  return bits;
}

// When lists have just been built it is not known yet which disks are near borders: all are taken to be.
double WindowRun::first_relist_time(std::size_t i, const WindowPlan& plan) const {
  return lists_.earliest_relist_time(static_cast<std::uint32_t>(i), window_.record[i].path, 0.0, plan.length,
                                     window_.rules.gravity, lists_.relist_distance_near_border());
}

}  // namespace carom
