// Keeps other programs off the processors while something is measured, on a machine that is shared. Only where it is
// asked for (CAROM_BENCH_SHIELD=1) and allowed (root): all other processes wait meanwhile.
#pragma once

#include <sched.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace carom::bench {

// From construction to destruction all threads of this process run before those of others.
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
  // The scheduling class is set thread by thread; threads made later inherit it. Where it is not allowed, nothing
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
