// Wall time spent in each phase of the step, by name. Measured, never read by the physics.
#pragma once

#include <chrono>
#include <string_view>
#include <vector>

namespace carom {

struct Phase {
  std::string_view name;  // a string literal
  double seconds = 0.0;
};

// Phases in the order in which they first ran.
class PhaseTimes {
 public:
  void add(std::string_view name, double seconds) {
    for (Phase& p : phases_) {
      if (p.name == name) {
        p.seconds += seconds;
        return;
      }
    }
    phases_.push_back({name, seconds});
  }
  const std::vector<Phase>& phases() const { return phases_; }

 private:
  std::vector<Phase> phases_;
};

// Adds the time from construction to destruction to one phase.
class PhaseTimer {
 public:
  PhaseTimer(PhaseTimes& times, std::string_view name) : times_(times), name_(name), start_(Clock::now()) {}
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;
  ~PhaseTimer() { times_.add(name_, std::chrono::duration<double>(Clock::now() - start_).count()); }

 private:
  using Clock = std::chrono::steady_clock;
  PhaseTimes& times_;
  std::string_view name_;
  Clock::time_point start_;
};

}  // namespace carom
