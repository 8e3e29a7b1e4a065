// The engine that people run: every method, in parallel, with the bits of core's reference.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// Precondition: threads.count >= 1, initial is a state of scene.
std::unique_ptr<Engine> make_parallel_engine(const Scene& scene, State initial, const Threads& threads);

}  // namespace carom
