// Keeps other programs off the processors during a measurement on a shared machine. Only if requested
// (CAROM_BENCH_SHIELD=1) and permitted (root): meanwhile all other processes wait.
#pragma once

#include <sched.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace carom::bench {

// From construction to destruction all threads of this process have priority over those of others.
class Shield {
 public:
  Shield() {
    if (wanted()) set(SCHED_FIFO, 10);
  }
  ~Shield() {
    if (wanted()) set(SCHED_OTHER, 0);
  }
  Shield(const Shield&) = delete;
  Shield& operator=(const Shield&) = delete;

  static bool wanted() {
    static const bool asked = std::getenv("CAROM_BENCH_SHIELD") != nullptr;
    return asked;
  }

 private:
  // The scheduling class is set for each thread; threads made later inherit it. Without the right to do so nothing
  // happens.
  static void set(int policy, int priority) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
      sched_setscheduler(std::stoi(task.path().filename().string()), policy, &parameters);
    }
  }
};

}  // namespace carom::bench
