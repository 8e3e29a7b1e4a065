#include "core/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "core/input_message.hpp"
#include "core/random.hpp"

namespace carom {

namespace {

// At packing fraction 0.5 the last of many equal disks needs about 2000 trials, the average one 100. These bounds reach
// 0.53 and more, and end a hopeless search in seconds (small scenes) to a minute (10^6 disks).
constexpr std::uint64_t most_trials_of_one = 2'000'000;
constexpr std::uint64_t most_trials_each = 400;
constexpr std::uint64_t most_trials_at_least = 20'000'000;

// Where a centre may lie: r off walls and sinks, anywhere along a periodic axis.
struct Room {
  double low = 0.0, high = 0.0;
  double at(double u) const { return std::min(high, low + (high - low) * u); }
};

Room room_along(double length, bool periodic, double radius) {
  return periodic ? Room{0.0, length} : Room{radius, length - radius};
}

struct Trials {
  std::uint64_t one = 0;  // for the disk at hand
  std::uint64_t all = 0;
};

// Tries places for disk i until one is free; false when the trials run out. Places are drawn a few ahead, so that
// their cells are fetched from memory together; which one is taken does not depend on how many.
bool place_one(const Scene& scene, Disks& disks, const PlacementGrid& grid, std::uint32_t i, Trials& trials,
               std::uint64_t most) {
  const double radius = disks.radius_of(i);
  const Room across = room_along(scene.box.width, scene.box.periodic_x(), radius);
  const Room up = room_along(scene.box.height, scene.box.periodic_y(), radius);
  std::array<Vec2, 16> ahead;
  std::size_t batch = 1;
  for (trials.one = 0; trials.one < most_trials_of_one && trials.all < most;
       batch = std::min(2 * batch, ahead.size())) {
    for (std::size_t b = 0; b < batch; ++b) {
      const TwoUniforms u = uniforms(scene.seed, Stream::position, i, trials.one + b);
      ahead[b] = {across.at(u.a), up.at(u.b)};
      if (scene.box.periodic_x()) ahead[b].x = wrap(ahead[b].x, scene.box.width);
      if (scene.box.periodic_y()) ahead[b].y = wrap(ahead[b].y, scene.box.height);
      grid.prefetch(ahead[b].x, ahead[b].y);
    }
    for (std::size_t b = 0; b < batch; ++b) {
      ++trials.one;
      ++trials.all;
      if (grid.overlapping(ahead[b].x, ahead[b].y, radius, false) != PlacementGrid::nobody) continue;
      disks.x[i] = ahead[b].x;
      disks.y[i] = ahead[b].y;
      return true;
    }
  }
  return false;
}

[[noreturn]] void fail_jammed(const Scene& scene, const Disks& disks, const std::vector<std::uint32_t>& members,
                              std::size_t placed, std::uint64_t trials) {
  double radius_squared = 0.0;
  for (std::size_t k = 0; k < placed; ++k) radius_squared += disks.radius_of(members[k]) * disks.radius_of(members[k]);
  const double reached = std::numbers::pi * radius_squared / (scene.box.width * scene.box.height);
  fail_input(
      place_in_group(scene, group_of(scene, members[placed]), "positions"),
      fmt::format("\"random\" finds no room for disk {} after {} trials: {} of {} placed, packing fraction {:.4f}",
                  members[placed], trials, placed, members.size(), reached),
      "expected fewer disks or a larger box, or positions = \"hexagonal\" or \"square\"");
}

}  // namespace

void place_at_random(const Scene& scene, Disks& disks, PlacementGrid& grid, std::vector<std::uint32_t> members) {
  if (!disks.radius.empty()) {
    std::stable_sort(members.begin(), members.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return disks.radius[a] > disks.radius[b]; });
  }
  const std::uint64_t most = std::max(most_trials_at_least, most_trials_each * members.size());
  Trials trials;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (!place_one(scene, disks, grid, members[k], trials, most)) fail_jammed(scene, disks, members, k, trials.one);
    grid.insert(members[k]);
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
