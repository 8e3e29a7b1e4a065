// The method `rollback`, in parallel.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// The same bits as make_reference_rollback. Preconditions: scene.run.dt > 0, threads.count >= 1.
std::unique_ptr<Engine> make_parallel_rollback(const Scene& scene, State initial, const Threads& threads);

}  // namespace carom
