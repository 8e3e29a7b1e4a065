#include "parallel/slabs/border_disks.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "parallel/slabs/moving_disks.hpp"

namespace carom {

namespace {

// A generous bound for the rounding of a thickness; share of the box's height.
constexpr double rounding = 1e-9;

// A disk may be near both borders, and two ranks are neighbours at both: duplicates are removed.
Disks each_once(std::vector<Disk> list) {
  std::sort(list.begin(), list.end(), [](const Disk& a, const Disk& b) { return a.id < b.id; });
  list.erase(std::unique(list.begin(), list.end(), [](const Disk& a, const Disk& b) { return a.id == b.id; }),
             list.end());
  Disks disks;
  for (const Disk& disk : list) push_back(disks, disk, {.radius = true, .mass = true});
  return disks;
}

std::vector<Disk> both_of(std::vector<Disk> one, const std::vector<Disk>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

}  // namespace

double excursion_over_ranks(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own) {
  double furthest = 0.0;
  for (const double y : own.y) {
    const Beyond b = beyond(slab, box, y);
    if (slab.has_lower) furthest = std::max(furthest, b.lower);
    if (slab.has_upper) furthest = std::max(furthest, b.upper);
  }
  ranks.maximum({&furthest, 1});
  return furthest;
}

BorderDisks disks_at_borders(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own, double reach,
                             double excursion) {
  std::vector<std::uint32_t> all(own.size());
  std::iota(all.begin(), all.end(), 0U);
  SeenBeyond seen;
  find_seen_beyond(slab, box, own, all, reach, excursion, seen);
  const SeenBeyond theirs = exchange_seen(ranks, seen);
  return {each_once(both_of(std::move(seen.below), seen.above)), each_once(both_of(theirs.below, theirs.above))};
}

bool is_within_neighbours(const SlabCut& cut, const Domain& box, double reach, double excursion) {
  return cut.thinnest() > reach + 2.0 * excursion + rounding * box.height;
}

Disks joined(const Disks& first, const Disks& second) {
  Disks both = first;
  for (std::size_t i = 0; i < second.size(); ++i) append(both, disk_at(second, i));
  return both;
}

}  // namespace carom
