#include "core/start/placement_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/base/input_message.hpp"
#include "core/disks/place_slack.hpp"
#include "core/scene/disk_group.hpp"
#include "core/start/placement.hpp"
#include "core/start/start_region.hpp"

namespace carom {

namespace {

// Most trials for each disk before a search is given up. Packing fraction 0.543 needs 40; 10^6 disks that cannot be
// placed are given up in under a minute.
constexpr std::uint64_t most_trials_each = 60;
constexpr std::uint64_t most_trials_at_least = 5'000'000;

PlacementRoom::Axis room_along(double length, bool periodic, double radius) {
  return periodic ? PlacementRoom::Axis{0.0, length} : PlacementRoom::Axis{radius, length - radius};
}

void narrow(PlacementRoom::Axis& axis, double low, double high) {
  axis.low = std::max(axis.low, low);
  axis.high = std::max(axis.low, std::min(axis.high, high));
}

// The end of the class that begins at members[begin]: radii above half of its radius. members are in descending order
// of radius.
std::size_t end_of_class(const Disks& disks, const std::vector<std::uint32_t>& members, std::size_t begin) {
  if (disks.radius.empty()) return members.size();
  const double half = 0.5 * disks.radius[members[begin]];
  std::size_t end = begin + 1;
  while (end < members.size() && disks.radius[members[end]] > half) ++end;
  return end;
}

}  // namespace

PlacementRoom placement_room(const Domain& box, double radius, const StartRegion* region) {
  PlacementRoom room{room_along(box.width, box.periodic_x(), radius), room_along(box.height, box.periodic_y(), radius)};
  if (region == nullptr) return room;
  if (!spans_x(*region, box)) narrow(room.across, region->low.x + radius, region->high.x - radius);
  if (!spans_y(*region, box)) narrow(room.up, region->low.y + radius, region->high.y - radius);
  if (region->circle) {
    // If one disk just fills the circle in decimals, rounding may put its only place beside the centre.
    const double reach = std::max(region->radius - radius, place_slack(box, radius));
    room.circle2 = reach * reach;
    room.middle = region->centre;
  }
  return room;
}

TrialDraw draw_trial(std::uint64_t seed, std::uint32_t id, std::uint64_t trial, bool listed) {
  return {uniforms(seed, Stream::position, id, trial), listed ? uniforms(seed, Stream::position, id, trial, 1).a : 0.0};
}

Vec2 trial_point(const Domain& box, const PlacementRoom& room, const VoxelList* list, const TrialDraw& draw) {
  Vec2 point{room.across.at(draw.place.a), room.up.at(draw.place.b)};
  if (list != nullptr) point = list->point(draw.place, draw.voxel);
  if (box.periodic_x()) point.x = wrap(point.x, box.width);
  if (box.periodic_y()) point.y = wrap(point.y, box.height);
  return point;
}

bool PlacementSearch::next_class() {
  begin = end;
  if (begin == members.size()) return false;
  end = end_of_class(disks, members, begin);
  trials_before = trials;
  cells.reset();
  list.reset();
  return true;
}

bool PlacementSearch::lesson_due(std::size_t k) const {
  if (list) return refine_due();
  if (cells) return cells->list_due();
  return trials_are_many(trials - trials_before, k - begin);
}

void PlacementSearch::learn() {
  if (list) {
    refine(list->survivors(grid, 0, list->size()));
  } else if (cells) {
    list.emplace(cells->list());
    cells.reset();
    in_vain = 0;
  } else {
    cells.emplace(scene.box, disks.radius_of(members[end - 1]), end - begin, region);
    grid.for_each([&](std::size_t i) { cells->close_around(disks.x[i], disks.y[i], disks.radius_of(i)); });
  }
}

void PlacementSearch::refine(std::vector<Voxel> survivors) {
  list->replace(std::move(survivors));
  in_vain = 0;
}

void PlacementSearch::refine_to(std::size_t size) {
  list->end_at(size);
  in_vain = 0;
}

// With a list, points are uniform over its voxels. Accepted points have the same distribution as without it, since all
// other points would have been rejected.
void PlacementSearch::place_one(std::size_t k) {
  const std::uint32_t i = members[k];
  const double radius = disks.radius_of(i);
  const PlacementRoom room = placement_room(scene.box, radius, region);
  for (trials_of_one = 0; trials_of_one < most_trials_of_one && trials < most; ++trials_of_one) {
    if (trials_of_one % trials_between_lessons == 0 && trials_of_one > 0 && lesson_due(k)) learn();
    if (list && list->empty()) break;
    const VoxelList* const listed = list ? &*list : nullptr;
    const TrialDraw draw = draw_trial(scene.seed, i, trials_of_one, listed != nullptr);
    const Vec2 point = trial_point(scene.box, room, listed, draw);
    const bool closed = cells && !cells->is_open(point.x, point.y);
    if (!closed && room.holds(point) && !grid.overlapping(point.x, point.y, radius, false)) {
      settle(i, point.x, point.y);
      return;
    }
    count(1);
  }
  fail_jammed(k);
}

void PlacementSearch::count(std::uint64_t trials_in_vain) {
  trials += trials_in_vain;
  in_vain += trials_in_vain;
}

void PlacementSearch::settle(std::uint32_t i, double x, double y) {
  disks.x[i] = x;
  disks.y[i] = y;
  grid.insert(i);
  if (cells) cells->close_around(x, y, disks.radius_of(i));
}

void PlacementSearch::fail_jammed(std::size_t k) const {
  double radius_squared = 0.0;
  const auto add = [&](std::size_t i) { radius_squared += disks.radius_of(i) * disks.radius_of(i); };
  if (region == nullptr) {
    grid.for_each(add);
  } else {
    std::for_each(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(k), add);
  }
  const double area = region == nullptr ? scene.box.width * scene.box.height : area_of(*region);
  fail_input(
      place_in_group(scene, group_of(scene, members[k]), "positions"),
      fmt::format("\"random\" finds no room for disk {}{} after {} trials; {} of {} placed, packing fraction {:.4f}",
                  members[k], region == nullptr ? "" : " in its region", trials_of_one, k, members.size(),
                  std::numbers::pi * radius_squared / area),
      "expected fewer disks or a larger box, or positions = \"growth\" (denser), \"hexagonal\" or \"square\"");
}

std::uint64_t most_trials(std::size_t members) {
  return std::max(most_trials_at_least, most_trials_each * members);
}

PlacementSearch make_placement_search(const Scene& scene, Disks& disks, PlacementGrid& grid,
                                      std::vector<std::uint32_t>& members) {
  if (!disks.radius.empty()) {
    std::stable_sort(members.begin(), members.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return disks.radius[a] > disks.radius[b]; });
  }
  const std::uint64_t most = most_trials(members.size());
  const StartRegion* region = nullptr;
  if (!members.empty()) {
    const auto& of_first = scene.groups[group_of(scene, members.front())].positions.region;
    if (of_first) region = &*of_first;
  }
  return {scene, disks, grid, members, region, most, 0, 0, std::nullopt, std::nullopt, 0, 0, 0, 0};
}

}  // namespace carom
