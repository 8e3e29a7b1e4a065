// Wall time, for costs and deadlines: nothing that decides bits may ask for it.
#pragma once

#include <chrono>

namespace carom {

using WallClock = std::chrono::steady_clock;

inline double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

}  // namespace carom
