// What stands in the box and no disk ever pushes: disks of infinite mass, and inner walls.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/types.hpp"
#include "core/disks/roughness.hpp"

namespace carom {

enum class ObstacleKind : std::uint8_t { disk, wall, sink };

// A fixed disk, or a straight piece of an inner wall: a segment without thickness and its two ends. It is no entry of
// Disks: it has no weight and no energy.
struct Obstacle {
  double x = 0.0, y = 0.0;    // centre, or where the segment begins; length
  double dx = 0.0, dy = 0.0;  // from there to where the segment ends; 0 of a disk
  double radius = 0.0;        // length; 0 of a segment
  double restitution = 1.0;   // of a disk that collides with it
  DiskId id = 0;              // that a disk has among the disks of the scene; number of a wall's [[walls]] table
  ObstacleKind kind = ObstacleKind::disk;
  bool moves = false;  // a segment that does: x and y are those at time 0 (ObstacleCells::motion_of)

  bool is_segment() const { return kind != ObstacleKind::disk; }
  // Whose surfaces touch where a disk meets it.
  Touching touching() const { return is_segment() ? Touching::wall : Touching::disks; }
};

// How messages call it: "fixed disk 7", "wall walls.2".
std::string name_of(const Obstacle& obstacle);

}  // namespace carom
