// How many threads an engine may use.
#pragma once

#include <cstddef>

namespace carom {

// How many threads to use. Results do not depend on either number. block_divisor > 1 cuts the work into more blocks
// than is good for speed: tests make small scenes parallel with it.
struct Threads {
  int count = 1;
  std::size_t block_divisor = 1;
};

}  // namespace carom
