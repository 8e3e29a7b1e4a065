// The kernels that relax supports and extrapolate their impulses, in versions for several instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/physics/support_solver.hpp"
#include "parallel/stepping/support_batches.hpp"

namespace carom {

struct SweepInput {
  const SupportBatch* batch;
  // One entry for each slot; as in SupportSet.
  double* impulse;
  double* last;
  double* before;
  double* ahead;
  const double* contact_distance;
  double* v;  // x and y of each disk's velocity
  double* last_v;
};

enum class Sweep { forward, back };

struct SweepKernels {
  // relax_forward or relax_back for batches [begin, end), without the sums of the figures. figures: null under
  // Watch::nothing.
  void (*relax)(const SweepInput& in, Sweep sweep, Watch watch, std::size_t begin, std::size_t end,
                CycleFigures* figures);
  // extrapolate_impulses for batches [begin, end).
  void (*extrapolate)(const SweepInput& in, std::size_t begin, std::size_t end, double momentum);
  // extrapolate_velocity for those of disks [begin, end) that have contacts.
  void (*extrapolate_velocities)(const SweepInput& in, const std::uint16_t* contacts, std::size_t begin,
                                 std::size_t end, double momentum);
};

SweepKernels sweep_kernels_baseline();
SweepKernels sweep_kernels_avx2();

// The best versions for this processor; all give the same bits.
SweepKernels choose_sweep_kernels();

}  // namespace carom
