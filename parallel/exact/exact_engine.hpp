// The method `exact` in parallel: the bits of core/reference/reference_exact.hpp at any number of threads.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/exact/border_watch.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// Preconditions as for make_reference_exact. watch: for tests and measurements of regions, called at the end of each of
// their slices. Where it is not empty, no window is run in parts, so that there are regions; it changes no bit.
std::unique_ptr<Engine> make_parallel_exact(const Scene& scene, State initial, const Threads& threads,
                                            const BorderWatch& watch = {});

}  // namespace carom
