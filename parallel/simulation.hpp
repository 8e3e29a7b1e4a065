// The engine that programs run: every method, in parallel, with the bits of core's reference.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// Preconditions: threads.count >= 1, and `initial` is a state of the scene.
std::unique_ptr<Engine> make_parallel_engine(const Scene& scene, State initial, const Threads& threads);

}  // namespace carom
