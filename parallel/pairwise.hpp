// The method `pairwise`, in parallel.
#pragma once

#include <memory>

#include "core/engine.hpp"

namespace carom {

// Bits of make_reference_pairwise. Preconditions: scene.run.dt > 0, threads >= 1.
std::unique_ptr<Engine> make_parallel_pairwise(const Scene& scene, State initial, int threads);

}  // namespace carom
