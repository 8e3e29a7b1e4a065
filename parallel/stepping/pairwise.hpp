// The method `pairwise`, in parallel.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// The same bits as make_reference_pairwise. Preconditions: scene.run.dt > 0, threads.count >= 1.
std::unique_ptr<Engine> make_parallel_pairwise(const Scene& scene, State initial, const Threads& threads);

}  // namespace carom
