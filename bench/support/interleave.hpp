// Comparing contenders on a machine whose speed changes from one second to the next: they take turns, round by round,
// and what is compared is their times within a round.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/support/shield.hpp"

namespace carom::bench {

struct Contender {
  std::string name;
  double work;  // what one run() is worth, to divide its time by
  std::function<void()> run;
  std::vector<double> times;  // seconds over work, one a round
  // Where what a run is worth is known only afterwards (collisions): counts it all, and stands in for `work`.
  std::function<double()> counter = {};
};

// Of an even number of values, the mean of the two in the middle. Precondition: there are some.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

inline double median_time(const Contender& c) {
  return median(c.times);
}

// Median over the rounds of a's time over b's.
inline double ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) ratios[k] = a[k] / b[k];
  return median(std::move(ratios));
}
inline double ratio(const Contender& a, const Contender& b) {
  return ratio(a.times, b.times);
}

// The first round warms up: its times are dropped. after_round, where given, is called after each round, the first too.
inline void interleave(std::vector<Contender>& contenders, int rounds, const std::function<void()>& after_round = {}) {
  using Clock = std::chrono::steady_clock;
  for (int round = 0; round <= rounds; ++round) {
    for (Contender& c : contenders) {
      const double before = c.counter ? c.counter() : 0.0;
      const Shield shield;
      const auto start = Clock::now();
      c.run();
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (round > 0) c.times.push_back(seconds / (c.counter ? c.counter() - before : c.work));
    }
    if (after_round) after_round();
  }
}

}  // namespace carom::bench
