// The number of threads of an engine.
#pragma once

#include <cstddef>

namespace carom {

// Results do not depend on either number. block_divisor > 1 cuts the work into more blocks than is efficient, so that
// tests can run small scenes in parallel.
struct Threads {
  int count = 1;
  std::size_t block_divisor = 1;
};

}  // namespace carom
