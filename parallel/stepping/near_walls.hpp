// The kernel that finds the disks near walls and obstacles, in versions for several instruction sets.
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
  const double* x;  // one entry for each disk; so have y and radius
  const double* y;
  const double* radius;  // null if all disks have the common radius
  double common_radius;
  double width, height;         // of the box
  std::array<double, 4> least;  // WallReach::least()
  // The clearance maps of the obstacles, their number, and whether their obstacles may have moved.
  std::array<Clearance::Cells, ObstacleCells::most_clearances> obstacles;
  std::size_t maps = 0;
  bool moving = false;
};

// The input for these disks in this box.
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

// Appends those of disks [begin, end) for which WallReach::touches is true, in order.
using NearWallsKernel = void (*)(const NearWallsInput& in, std::size_t begin, std::size_t end,
                                 std::vector<std::uint32_t>& near);

void near_walls_baseline(const NearWallsInput& in, std::size_t begin, std::size_t end,
                         std::vector<std::uint32_t>& near);
void near_walls_avx2(const NearWallsInput& in, std::size_t begin, std::size_t end, std::vector<std::uint32_t>& near);

// The best version for this processor; all find the same disks.
NearWallsKernel choose_near_walls_kernel();

}  // namespace carom
