// Obstacles in the box, which no disk can move: disks of infinite mass, inner walls and inner sinks.
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
  double x = 0.0, y = 0.0;    // centre, or first end of the segment; length
  double dx = 0.0, dy = 0.0;  // from there to the other end; 0 for a disk
  double radius = 0.0;        // length; 0 of a segment
  double restitution = 1.0;   // of a disk that collides with it
  DiskId id = 0;              // of a fixed disk, among those of all disks; of a wall, the number of its [[walls]] table
  ObstacleKind kind = ObstacleKind::disk;
  bool moves = false;  // x and y are then those at time 0 (ObstacleCells::motion_of)

  bool is_segment() const { return kind != ObstacleKind::disk; }
  // The kind of surfaces that touch in a contact with it.
  Touching touching() const { return is_segment() ? Touching::wall : Touching::disks; }
};

// Its name in messages: "fixed disk 7", "wall walls.2".
std::string name_of(const Obstacle& obstacle);

}  // namespace carom
