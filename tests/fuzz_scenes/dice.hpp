// Draws for random scenes: the n-th draw of a scene is a function of (seed, scene, attempt, n), computed by the
// engine's own counter-based generator, so that a scene is the same on every machine.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>

#include "core/base/random.hpp"

namespace carom::fuzz {

class Dice {
 public:
  Dice(std::uint64_t seed, std::uint32_t scene, std::uint32_t attempt)
      : seed_(seed), scene_(scene), attempt_(attempt) {}

  double unit() { return uniforms(seed_, Stream::position, scene_, drawn_++, attempt_).a; }
  double in(double low, double high) { return low + (high - low) * unit(); }
  bool chance(double share) { return unit() < share; }
  // A random number of 0 .. n - 1.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(unit() * static_cast<double>(n)); }
  // From 10^low to 10^high, with equal probability for every decade.
  double decades(int low, int high) {
    double value = in(1.0, 10.0);
    for (int k = low + static_cast<int>(below(static_cast<std::size_t>(high - low))); k != 0; k -= k > 0 ? 1 : -1) {
      value = k > 0 ? value * 10.0 : value / 10.0;
    }
    return value;
  }
  template <class T>
  T pick(std::initializer_list<T> choices) {
    return choices.begin()[below(choices.size())];
  }

 private:
  std::uint64_t seed_;
  std::uint32_t scene_, attempt_;
  std::uint64_t drawn_ = 0;
};

// Rounded to four digits, as a person would write it.
inline double rounded(double x) {
  return std::strtod(fmt::format("{:.4g}", x).c_str(), nullptr);
}

}  // namespace carom::fuzz
