// Wall time spent in each phase of the step, by name. The physics never reads it.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/base/wall_clock.hpp"

namespace carom {

struct Phase {
  std::string_view name;  // a string literal
  double seconds = 0.0;
};

// Phases in the order in which they first ran.
class PhaseTimes {
 public:
  // So add() allocates nothing: it is called from destructors, also while an exception for lack of memory passes.
  PhaseTimes() {
    constexpr std::size_t more_than_there_are = 32;
    phases_.reserve(more_than_there_are);
  }
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
  PhaseTimer(PhaseTimes& times, std::string_view name) : times_(times), name_(name) {}
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;
  ~PhaseTimer() { times_.add(name_, seconds_since(start_)); }

 private:
  PhaseTimes& times_;
  std::string_view name_;
  WallClock::time_point start_ = WallClock::now();
};

}  // namespace carom
