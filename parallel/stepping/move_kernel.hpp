// The kernels that move disks and write the coarse positions for the contact search, in versions for several
// instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

// parabola: gravity along y; tilted_parabola: in any direction.
enum class Motion { none, straight, parabola, tilted_parabola };

struct MoveInput {
  double* x;
  double* y;
  double* vx;
  double* vy;
  const std::uint32_t* key;  // the cell into which the disk was sorted
  std::uint32_t* position;   // coarse (coarse_positions.hpp)
  Domain box;
  Motion motion;
  double t;
  Gravity gravity;
};

// Moves disks [begin, end) of a level as drift and wrap do (core/physics/advance.hpp), with the same operations; writes
// their coarse positions, and appends those that are further outside their cell than the margin to `strays`. Returns
// their largest squared speed; meaningless with Motion::none.
using MoveKernel = double (*)(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                              std::vector<std::uint32_t>& strays);

// Moves disks [begin, end) of a sheared box by in.t, and appends those that are now outside the box to `crossed`,
// without wrapping them. Returns the largest squared speed of the others. Uses neither cells nor gravity.
using ShearedMoveKernel = double (*)(const MoveInput& in, std::size_t begin, std::size_t end,
                                     std::vector<std::uint32_t>& crossed);

double move_disks_baseline(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                           std::vector<std::uint32_t>& strays);
double move_disks_avx2(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                       std::vector<std::uint32_t>& strays);

double move_sheared_baseline(const MoveInput& in, std::size_t begin, std::size_t end,
                             std::vector<std::uint32_t>& crossed);
double move_sheared_avx2(const MoveInput& in, std::size_t begin, std::size_t end, std::vector<std::uint32_t>& crossed);

struct MoveKernels {
  MoveKernel in_levels;
  ShearedMoveKernel sheared;
};

// The best versions for this processor; all give the same bits.
MoveKernels choose_move_kernels();

}  // namespace carom
