// Queries: the disks in a rectangle, the one nearest to a place, the first one that a ray meets. They include fixed
// disks; inner walls stop rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/obstacle_cells.hpp"

namespace carom {

// Calls visit(i) for every disk (storage index) whose centre is within half_width and half_height of a place inside the
// box, including nearest images; possibly for others too, and for some twice.
using Visit = std::function<void(std::size_t)>;
using VisitNear = std::function<void(Vec2 centre, double half_width, double half_height, const Visit& visit)>;

// Visits all disks, whatever the place.
VisitNear visit_all(const Disks& disks);

// The disks and walls of queries; all of it outlives them.
struct QueryScene {
  const Disks& disks;
  const Domain& box;
  VisitNear near;
  const ObstacleCells* fixed = nullptr;  // fixed disks; null if there are none
  const ObstacleCells* walls = nullptr;  // inner walls; null if there are none

  std::size_t count() const { return disks.size() + (fixed != nullptr ? fixed->size() : 0); }
};

struct NearDisk {
  DiskId id = 0;
  double distance = 0.0;  // of the centre, to the nearest image
};

enum class RayMet : std::uint8_t { disk, wall, sink };

struct RayHit {
  DiskId id = 0;          // of a disk; for a wall, the number of its [[walls]] table
  double distance = 0.0;  // along the ray to the disk's edge, or to the wall; 0 if the ray begins inside a disk
  Vec2 place{};           // the place of the hit, inside the box
  RayMet what = RayMet::disk;
};

// Ids, ascending, of the disks whose centres are in the rectangle or on its sides. Across periodic sides the rectangle
// may reach out of the box, and contains images; one at least as long as the box contains all. Throws InputError if a
// number is not finite or low is above high.
std::vector<DiskId> disks_in(const QueryScene& scene, Vec2 low, Vec2 high);

// The disk whose centre is nearest to a place, of two at the same distance the one with the smaller id; absent without
// disks. Throws InputError if the place is not finite or is outside the box.
std::optional<NearDisk> nearest_disk(const QueryScene& scene, Vec2 place);

// The first disk or inner wall on a straight line of this length; at the same distance the disk is first. A line along
// a wall does not meet it. The line continues through periodic sides and ends at others. Throws InputError if a number
// is not finite, the direction is 0, the line begins outside the box, or its length is negative or more than 10^6 times
// the box.
std::optional<RayHit> cast_ray(const QueryScene& scene, Vec2 from, Vec2 direction, double length);

}  // namespace carom
