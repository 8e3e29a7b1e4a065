// The method `exact` in parallel: the bits of core/reference/reference_exact.hpp at any number of threads.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// Preconditions as for make_reference_exact.
std::unique_ptr<Engine> make_parallel_exact(const Scene& scene, State initial, const Threads& threads);

}  // namespace carom
