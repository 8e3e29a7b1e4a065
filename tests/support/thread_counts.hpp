// On how many threads the engine is held against the reference.
#pragma once

#include <array>

namespace carom::test {

// A race is between two: the thread sanitizer, which makes everything ten times as long, sees it on three threads as on
// eight. Memory is shared out among one thread or several.
#ifdef CAROM_THREAD_SANITIZER
inline constexpr std::array thread_counts{2, 3};
#elif defined CAROM_ADDRESS_SANITIZER
inline constexpr std::array thread_counts{1, 3};
#else
inline constexpr std::array thread_counts{1, 2, 3, 5, 8};
#endif

}  // namespace carom::test
