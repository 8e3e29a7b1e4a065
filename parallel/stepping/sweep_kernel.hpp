// The kernels that relax supports and extrapolate their impulses, in the versions that this machine may have.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/physics/support_solver.hpp"
#include "parallel/stepping/support_batches.hpp"

namespace carom {

struct SweepInput {
  const SupportBatch* batch;
  // An entry a slot; as in SupportSet.
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
  // What relax_forward or relax_back do, of batches [begin, end); the figures' sums stay. figures: null where nothing
  // is watched.
  void (*relax)(const SweepInput& in, Sweep sweep, Watch watch, std::size_t begin, std::size_t end,
                CycleFigures* figures);
  // What extrapolate_impulses does, of batches [begin, end).
  void (*extrapolate)(const SweepInput& in, std::size_t begin, std::size_t end, double momentum);
  // What extrapolate_velocity does, of those of disks [begin, end) that have contacts.
  void (*extrapolate_velocities)(const SweepInput& in, const std::uint16_t* contacts, std::size_t begin,
                                 std::size_t end, double momentum);
};

SweepKernels sweep_kernels_baseline();
SweepKernels sweep_kernels_avx2();

// The best versions for the processor at hand; all have the same bits.
SweepKernels choose_sweep_kernels();

}  // namespace carom
