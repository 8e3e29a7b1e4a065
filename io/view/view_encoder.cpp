#include "io/view/view_encoder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "core/base/types.hpp"

namespace carom {

namespace {

// A block ends with this number of frames, or of disks of all its frames, but has the least number of frames: so few
// that a page can unpack it while it plays, and so many that the first frame, which has no other to predict it, costs
// little.
constexpr std::size_t most_frames = 64;
constexpr std::size_t least_frames = 8;
constexpr std::size_t most_disks = std::size_t{1} << 21U;

// Replaces the step by that to the nearest image; returns how many boxes further along the axis that image is, -1, 0 or
// 1.
int take_nearest(const ViewAxis& axis, double& step) {
  const double steps = static_cast<double>(axis.mask()) + 1.0;
  if (!axis.periodic || std::abs(step) <= 0.5 * steps) return 0;
  const int turns = step > 0.0 ? -1 : 1;
  step += turns * steps;
  return turns;
}

// The displacement of a disk, across sides if that is shorter; length. offset: of the images above, at the later time.
Vec2 step_between(const ViewAxes& axes, std::array<std::uint32_t, 2> from, std::array<std::uint32_t, 2> to,
                  double offset) {
  double dx = static_cast<double>(to[0]) - static_cast<double>(from[0]);
  double dy = static_cast<double>(to[1]) - static_cast<double>(from[1]);
  dx += take_nearest(axes[1], dy) * offset / axes[0].quantum();
  take_nearest(axes[0], dx);
  return {dx * axes[0].quantum(), dy * axes[1].quantum()};
}

// The storage indices of the disks whose id is a multiple of `every`.
std::vector<std::size_t> multiples_of(DiskId every, const std::vector<DiskId>& ids) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] % every == 0) chosen.push_back(i);
  }
  return chosen;
}

void sort_by_place(ViewFrame& view) {
  const std::vector<std::uint32_t>& place = view.place;
  if (std::adjacent_find(place.begin(), place.end(), std::greater_equal<>()) == place.end()) return;
  std::vector<std::size_t> order(place.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });
  ViewFrame sorted = view;
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted.place[k] = place[order[k]];
    for (std::size_t axis = 0; axis < 2; ++axis) sorted.at[axis][k] = view.at[axis][order[k]];
  }
  view = std::move(sorted);
}

}  // namespace

ViewEncoder::ViewEncoder(const ViewAxes& axes, DiskId every, std::size_t at_once, BlockRunner run, const Shear& shear)
    : axes_(axes),
      every_(every),
      at_once_(std::max<std::size_t>(1, at_once)),
      run_(std::move(run)),
      shear_(shear),
      waiting_(1) {}

double ViewEncoder::offset_at(double time) const {
  return shear_.acts() ? shear_.offset_at(time, axes_[0].length) : 0.0;
}

// If ids come in ascending order, as they do except in regions that disks enter and leave, places also ascend.
std::uint32_t ViewEncoder::place_of(const TrajectoryFrame& frame, std::size_t i) {
  const DiskId id = frame.disks.id[i];
  const auto [known, is_new] = places_.try_emplace(id, static_cast<std::uint32_t>(disks_.id.size()));
  if (!is_new) return known->second;
  disks_.id.push_back(id);
  disks_.radius.push_back(frame.disks.radius_of(i));
  disks_.mass.push_back(frame.disks.mass_of(i));
  disks_.group.push_back(frame.group.empty() ? 0 : frame.group[i]);  // frames of other programs may differ in columns
  return known->second;
}

// Must be called before the frame's time is added.
void ViewEncoder::look_at_speeds(const ViewFrame& frame, double time) {
  constexpr std::size_t most = 1000;
  ViewFrame sample;
  const double dt = times_.empty() ? 0.0 : time - times_.back();
  const double offset = offset_at(time);
  for (std::size_t k = 0, j = 0; k < frame.place.size(); k += 1 + frame.place.size() / most) {
    sample.place.push_back(frame.place[k]);
    for (std::size_t axis = 0; axis < 2; ++axis) sample.at[axis].push_back(frame.at[axis][k]);
    while (j < sampled_.place.size() && sampled_.place[j] < frame.place[k]) ++j;
    if (!(dt > 0.0) || j == sampled_.place.size() || sampled_.place[j] != frame.place[k]) continue;
    const Vec2 d =
        step_between(axes_, {sampled_.at[0][j], sampled_.at[1][j]}, {frame.at[0][k], frame.at[1][k]}, offset);
    const double square = (d.x * d.x + d.y * d.y) / (dt * dt);
    squares_ += square;
    fastest_ = std::max(fastest_, square);
    speeds_ += 1.0;
  }
  sampled_ = std::move(sample);
}

double ViewEncoder::fast_speed() const {
  return speeds_ > 0.0 ? std::min(std::sqrt(fastest_), 2.5 * std::sqrt(squares_ / speeds_)) : 0.0;
}

// The disks that are shown, in the order of the trajectory's frame. A new disk gets a place.
ViewFrame ViewEncoder::encoded(const TrajectoryFrame& frame) {
  const Disks& disks = frame.disks;
  const ViewAxes axes = axes_;  // a copy that the writes below cannot change
  const std::vector<std::size_t> chosen = every_ > 1 ? multiples_of(every_, disks.id) : std::vector<std::size_t>{};
  const std::size_t count = every_ > 1 ? chosen.size() : disks.size();
  const ViewFrame* const last = waiting_.back().empty() ? nullptr : &waiting_.back().back();
  ViewFrame view;
  view.place.resize(count);
  for (auto& column : view.at) column.resize(count);
  const double offset = offset_at(frame.time);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = every_ > 1 ? chosen[k] : k;
    // In most cases the same disks follow each other in the same order as in the frame before.
    const bool as_before = last != nullptr && k < last->place.size() && disks_.id[last->place[k]] == disks.id[i];
    view.place[k] = as_before ? last->place[k] : place_of(frame, i);
    view.at[1][k] = axes[1].encode(disks.y[i]);
    // A place just below the top of a sheared box becomes its image at the bottom, which is displaced.
    const bool below = offset != 0.0 && view.at[1][k] == 0 && disks.y[i] > 0.5 * axes[1].length;
    view.at[0][k] = axes[0].encode(below ? disks.x[i] - offset : disks.x[i]);
  }
  return view;
}

// Appends the frame to the growing block, and ends the block if it is large enough.
void ViewEncoder::add_to_block(ViewFrame&& view) {
  const std::size_t count = view.place.size();
  disk_frames_ += count;
  in_last_ += count;
  waiting_.back().push_back(std::move(view));
  const std::size_t frames = waiting_.back().size();
  if (frames < most_frames && (in_last_ + count <= most_disks || frames < least_frames)) return;
  in_last_ = 0;
  if (waiting_.size() >= at_once_) pack_waiting();
  waiting_.emplace_back();
}

void ViewEncoder::add(const TrajectoryFrame& frame) {
  ViewFrame view = encoded(frame);
  sort_by_place(view);
  look_at_speeds(view, frame.time);
  times_.push_back(frame.time);
  add_to_block(std::move(view));
}

void ViewEncoder::pack_waiting() {
  std::vector<std::size_t> first(waiting_.size());
  for (std::size_t b = 0; b < waiting_.size(); ++b) {
    first[b] = packed_frames_;
    packed_frames_ += waiting_[b].size();
  }
  std::vector<ViewBlock> made(waiting_.size());
  run_(waiting_.size(), [&](std::size_t b) { made[b] = pack_view_block(waiting_[b], first[b], axes_); });
  for (ViewBlock& block : made) {
    packed_bytes_ += block.packed.size();
    blocks_.push_back(std::move(block));
  }
  waiting_.clear();
}

void ViewEncoder::finish() {
  if (!waiting_.empty() && waiting_.back().empty()) waiting_.pop_back();
  if (!waiting_.empty()) pack_waiting();
  waiting_.assign(1, {});
  in_last_ = 0;
}

}  // namespace carom
