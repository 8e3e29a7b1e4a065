#include "core/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "core/input_message.hpp"
#include "core/open_cells.hpp"
#include "core/random.hpp"

namespace carom {

namespace {

// Trials that a search without hope may cost. Packing fraction 0.543 needs 40 a disk; 10^6 disks that cannot be placed
// are given up in under a minute.
constexpr std::uint64_t most_trials_of_one = 200'000;
constexpr std::uint64_t most_trials_each = 60;
constexpr std::uint64_t most_trials_at_least = 5'000'000;

// Trials a disk, on average, from which it pays to know the open cells.
constexpr std::uint64_t many_trials = 4;

// Where a centre may lie: r off walls and sinks, anywhere along a periodic axis.
struct Room {
  double low = 0.0, high = 0.0;
  bool holds(double c) const { return c >= low && c <= high; }
  double at(double u) const { return std::min(high, low + (high - low) * u); }
};

Room room_along(double length, bool periodic, double radius) {
  return periodic ? Room{0.0, length} : Room{radius, length - radius};
}

// Random sequential addition of disks whose radii differ by less than a factor of two.
struct Search {
  const Scene& scene;
  Disks& disks;
  PlacementGrid& grid;
  std::optional<OpenCells> cells;   // made once trials become many
  std::uint64_t trials = 0;         // so far, all disks
  std::uint64_t trials_of_one = 0;  // for the disk at hand
};

// Trial k of disk i: a point of its room, or nothing if it is known to be taken. With a list of open cells, uniform
// over those: an accepted point has the same distribution, as the rest would have been refused.
std::optional<Vec2> draw_point(Search& s, std::uint32_t i, std::uint64_t k, const Room& across, const Room& up) {
  const TwoUniforms u = uniforms(s.scene.seed, Stream::position, i, k);
  Vec2 point{across.at(u.a), up.at(u.b)};
  if (s.cells && s.cells->list_ready()) {
    point = s.cells->point_in_list(u, uniforms(s.scene.seed, Stream::position, i, k, 1).a);
  }
  if (s.scene.box.periodic_x()) point.x = wrap(point.x, s.scene.box.width);
  if (s.scene.box.periodic_y()) point.y = wrap(point.y, s.scene.box.height);
  if (s.cells && !s.cells->is_open(point.x, point.y)) return std::nullopt;
  if (!across.holds(point.x) || !up.holds(point.y)) return std::nullopt;
  return point;
}

// Tries points for disk i until one is free; false when there is no room, or the trials run out.
bool place_one(Search& s, std::uint32_t i, std::uint64_t most) {
  const Domain& box = s.scene.box;
  const double radius = s.disks.radius_of(i);
  const Room across = room_along(box.width, box.periodic_x(), radius);
  const Room up = room_along(box.height, box.periodic_y(), radius);
  for (s.trials_of_one = 0; s.trials_of_one < most_trials_of_one && s.trials < most; ++s.trials_of_one, ++s.trials) {
    if (s.cells && s.cells->full()) return false;
    const std::optional<Vec2> point = draw_point(s, i, s.trials_of_one, across, up);
    if (!point || s.grid.overlapping(point->x, point->y, radius, false) != PlacementGrid::nobody) continue;
    s.disks.x[i] = point->x;
    s.disks.y[i] = point->y;
    s.grid.insert(i);
    if (s.cells) s.cells->close_around(point->x, point->y, radius);
    return true;
  }
  return false;
}

[[noreturn]] void fail_jammed(const Search& s, const std::vector<std::uint32_t>& members, std::size_t placed) {
  double radius_squared = 0.0;
  s.grid.for_each([&](std::size_t i) { radius_squared += s.disks.radius_of(i) * s.disks.radius_of(i); });
  const double reached = std::numbers::pi * radius_squared / (s.scene.box.width * s.scene.box.height);
  fail_input(
      place_in_group(s.scene, group_of(s.scene, members[placed]), "positions"),
      fmt::format("\"random\" finds no room for disk {} after {} trials; {} of {} placed, packing fraction {:.4f}",
                  members[placed], s.trials_of_one, placed, members.size(), reached),
      "expected fewer disks or a larger box, or positions = \"hexagonal\" or \"square\"");
}

// One past the last member whose radius is above half of that of members[begin]; members are in order of radius.
std::size_t end_of_class(const Disks& disks, const std::vector<std::uint32_t>& members, std::size_t begin) {
  if (disks.radius.empty()) return members.size();
  const double half = 0.5 * disks.radius[members[begin]];
  std::size_t end = begin + 1;
  while (end < members.size() && disks.radius[members[end]] > half) ++end;
  return end;
}

}  // namespace

void place_at_random(const Scene& scene, Disks& disks, PlacementGrid& grid, std::vector<std::uint32_t> members) {
  if (!disks.radius.empty()) {
    std::stable_sort(members.begin(), members.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return disks.radius[a] > disks.radius[b]; });
  }
  const std::uint64_t most = std::max(most_trials_at_least, most_trials_each * members.size());
  Search search{scene, disks, grid, std::nullopt};
  for (std::size_t begin = 0; begin < members.size();) {
    const std::size_t end = end_of_class(disks, members, begin);
    const std::uint64_t trials_before = search.trials;
    search.cells.reset();
    for (std::size_t k = begin; k < end; ++k) {
      if (!search.cells && search.trials - trials_before > many_trials * (k - begin) + 1000) {
        search.cells.emplace(scene.box, disks.radius_of(members[end - 1]), end - begin);
        grid.for_each([&](std::size_t i) { search.cells->close_around(disks.x[i], disks.y[i], disks.radius_of(i)); });
      }
      if (!place_one(search, members[k], most)) fail_jammed(search, members, k);
    }
    begin = end;
  }
}

std::string place_in_group(const Scene& scene, std::size_t group, std::string_view key) {
  const DiskGroup& g = scene.groups[group];
  if (key == "positions" && !g.positions.where.empty()) return g.positions.where;
  return fmt::format("{}:{}: disks.{}.{}", scene.file, g.line, group, key);
}

std::size_t group_of(const Scene& scene, DiskId id) {
  std::size_t group = 0;
  Count end = scene.groups[0].count;
  while (id >= end) end += scene.groups[++group].count;
  return group;
}

}  // namespace carom
