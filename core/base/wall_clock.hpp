// Wall time, for costs and deadlines. Nothing that decides the bits of a run may depend on it.
#pragma once

#include <chrono>

namespace carom {

using WallClock = std::chrono::steady_clock;

inline double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

}  // namespace carom
