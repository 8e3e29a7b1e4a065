// Random numbers for tests: the same on every machine, and independent of the tested generator.
#pragma once

#include <cmath>
#include <cstdint>

namespace carom::test {

// splitmix64.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  double in(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
  // Every decade is equally likely.
  double decades(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }

 private:
  std::uint64_t state_;
};

}  // namespace carom::test
