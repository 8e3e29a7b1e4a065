// The kernels that move disks, and write the coarse positions that the contact search reads, in the versions that this
// machine may have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

// A parabola has its axis along y, a tilted one any.
enum class Motion { none, straight, parabola, tilted_parabola };

struct MoveInput {
  double* x;
  double* y;
  double* vx;
  double* vy;
  const std::uint32_t* key;  // cell that the disk was sorted into
  std::uint32_t* position;   // coarse (coarse_positions.hpp)
  Domain box;
  Motion motion;
  double t;
  Gravity gravity;
};

// Moves disks [begin, end) of a level as drift and wrap do (core/physics/advance.hpp), with the same operations; writes
// their coarse positions, and appends those that are further outside their cell than the margin. Returns their largest
// squared speed; where they do not move, a number that says nothing.
using MoveKernel = double (*)(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                              std::vector<std::uint32_t>& strays);

// Moves disks [begin, end) of a sheared box likewise, by in.t, but leaves those in `crossed` that are out of the box
// now, wherever they are; is appended to. Returns the largest squared speed of the others. Reads neither cells nor
// gravity.
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

// The best versions for the processor at hand; all give the same bits.
MoveKernels choose_move_kernels();

}  // namespace carom
