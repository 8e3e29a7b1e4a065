// The engine that people run: every method, in parallel, with the bits of core's reference.
#pragma once

#include <cstddef>
#include <memory>

#include "core/step/engine.hpp"

namespace carom {

// How many threads to use. Results do not depend on either number. block_divisor > 1 cuts the work into more blocks
// than is good for speed: tests make small scenes parallel with it.
struct Threads {
  int count = 1;
  std::size_t block_divisor = 1;
};

// Precondition: threads.count >= 1, initial is a state of scene. Throws InputError for a method that does not exist
// yet.
std::unique_ptr<Engine> make_parallel_engine(const Scene& scene, State initial, const Threads& threads);

}  // namespace carom
