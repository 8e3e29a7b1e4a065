// Comparisons on a machine whose speed changes from one second to the next: contenders take turns, round by round, and
// their times within a round are compared.
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
  double work;  // amount of work in one run(), by which its time is divided
  std::function<void()> run;
  std::vector<double> times;  // seconds over work, one for each round
  // If the work of a run is known only afterwards (collisions): the total count so far, used instead of `work`.
  std::function<double()> counter = {};
};

// For an even number of values, the mean of the two in the middle. Precondition: there are some.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

inline double median_time(const Contender& c) {
  return median(c.times);
}

// The median over the rounds of a's time over b's.
inline double ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) ratios[k] = a[k] / b[k];
  return median(std::move(ratios));
}
inline double ratio(const Contender& a, const Contender& b) {
  return ratio(a.times, b.times);
}

// The first round warms up, and its times are dropped. after_round, if given, is called after each round, including the
// first.
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
