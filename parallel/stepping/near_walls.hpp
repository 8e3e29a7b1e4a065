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
  // Of the obstacles at rest, and of those that move; no cells: none are there.
  std::array<Clearance::Cells, 2> obstacles;
};

// Of these disks in this box.
inline NearWallsInput near_walls_input(const Disks& disks, const Domain& box) {
  NearWallsInput in{disks.x.data(),
                    disks.y.data(),
                    disks.radius.empty() ? nullptr : disks.radius.data(),
                    disks.common_radius,
                    box.width,
                    box.height,
                    WallReach(box).least(),
                    {}};
  if (box.obstacles != nullptr) in.obstacles = {box.obstacles->clearance_at_rest(), box.obstacles->clearance_swept()};
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
