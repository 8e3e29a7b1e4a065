// The kernel that finds the disks at walls and obstacles, in the versions that this machine may have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/clearance.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "parallel/stepping/wall_reach.hpp"

namespace carom {

struct NearWallsInput {
  const double* x;  // one entry a disk, as y and radius
  const double* y;
  const double* radius;  // null where all have the common one
  double common_radius;
  double width, height;         // of the box
  std::array<double, 4> least;  // as WallReach::least()
  // Of the obstacles: so many maps of how far they are, and whether what they show may have moved.
  std::array<Clearance::Cells, ObstacleCells::most_clearances> obstacles;
  std::size_t maps = 0;
  bool moving = false;
};

// Of these disks in this box.
inline NearWallsInput near_walls_input(const Disks& disks, const Domain& box) {
  NearWallsInput in{};
  in.x = disks.x.data();
  in.y = disks.y.data();
  in.radius = disks.radius.empty() ? nullptr : disks.radius.data();
  in.common_radius = disks.common_radius;
  in.width = box.width;
  in.height = box.height;
  in.least = WallReach(box).least();
  if (box.obstacles == nullptr) return in;
  in.maps = box.obstacles->clearances();
  in.moving = box.obstacles->move();
  for (std::size_t k = 0; k < in.maps; ++k) in.obstacles[k] = box.obstacles->clearance_cells(k);
  return in;
}

// Appends those of disks [begin, end) for which WallReach::touches is true, in their order.
using NearWallsKernel = void (*)(const NearWallsInput& in, std::size_t begin, std::size_t end,
                                 std::vector<std::uint32_t>& near);

void near_walls_baseline(const NearWallsInput& in, std::size_t begin, std::size_t end,
                         std::vector<std::uint32_t>& near);
void near_walls_avx2(const NearWallsInput& in, std::size_t begin, std::size_t end, std::vector<std::uint32_t>& near);

// The best version for the processor at hand; all find the same disks.
NearWallsKernel choose_near_walls_kernel();

}  // namespace carom
