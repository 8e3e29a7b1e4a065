// Which disks are in a rectangle, which is nearest to a place, what a ray meets first. Fixed disks are seen as others
// are; inner walls stop rays.
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
// box, nearest images included; perhaps for others too, and for some twice.
using Visit = std::function<void(std::size_t)>;
using VisitNear = std::function<void(Vec2 centre, double half_width, double half_height, const Visit& visit)>;

// All disks, whatever the place.
VisitNear visit_all(const Disks& disks);

// What queries are about; all of it outlives them.
struct QueryScene {
  const Disks& disks;
  const Domain& box;
  VisitNear near;
  const ObstacleCells* fixed = nullptr;  // disks; null where there are none
  const ObstacleCells* walls = nullptr;  // inner ones; likewise

  std::size_t count() const { return disks.size() + (fixed != nullptr ? fixed->size() : 0); }
};

struct NearDisk {
  DiskId id = 0;
  double distance = 0.0;  // of the centre, to the nearest image
};

enum class RayMet : std::uint8_t { disk, wall, sink };

struct RayHit {
  DiskId id = 0;          // of a wall, the number of its [[walls]] table
  double distance = 0.0;  // along the ray to the disk's edge, or to the wall; 0 if the ray begins inside a disk
  Vec2 place{};           // there, inside the box
  RayMet what = RayMet::disk;
};

// Ids, ascending, of the disks whose centres lie in the rectangle, its sides included. Across periodic sides it may
// reach out of the box, and sees images; one that is as long as the box or longer sees all. Throws InputError where a
// number is not finite or low is above high.
std::vector<DiskId> disks_in(const QueryScene& scene, Vec2 low, Vec2 high);

// The disk with its centre nearest to a place, of two as near the one with the smaller id; absent without disks. Throws
// InputError where the place is not finite or lies outside the box.
std::optional<NearDisk> nearest_disk(const QueryScene& scene, Vec2 place);

// The first disk or inner wall on a straight line of this length, the disk of two as near; a line along a wall does not
// meet it. The line goes through periodic sides and ends at others. Throws InputError where a number is not finite, the
// direction is 0, the line begins outside the box, its length is below 0, or more than 10^6 times the box.
std::optional<RayHit> cast_ray(const QueryScene& scene, Vec2 from, Vec2 direction, double length);

}  // namespace carom
