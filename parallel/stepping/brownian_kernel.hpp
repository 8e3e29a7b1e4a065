// The kernel that draws Brownian velocities, in the versions that this machine may have.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/types.hpp"

namespace carom {

struct BrownianInput {
  double* vx;
  double* vy;
  const DiskId* id;
  std::uint64_t seed;
  std::uint64_t step;
  double speed;     // of one component, root mean square (core/physics/advance.hpp); length / time
  bool accumulate;  // adds what is drawn to the velocity, in place of setting it
};

// Draws the velocities of disks [begin, end) as draw_brownian does (core/step/step_start.hpp). Returns their largest
// squared speed.
using BrownianKernel = double (*)(const BrownianInput& in, std::size_t begin, std::size_t end);

double draw_brownian_baseline(const BrownianInput& in, std::size_t begin, std::size_t end);
double draw_brownian_avx2(const BrownianInput& in, std::size_t begin, std::size_t end);

// The best version for the processor at hand; all give the same bits.
BrownianKernel choose_brownian_kernel();

}  // namespace carom
