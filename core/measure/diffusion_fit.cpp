#include "core/measure/diffusion_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {
constexpr std::size_t slopes = 8;
}

DiffusionFit fit_diffusion(const std::vector<double>& time, const std::vector<double>& square, double dimensions) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  DiffusionFit fit{nothing, nothing, nothing};
  if (time.empty()) return fit;
  const double middle = 0.5 * (time.front() + time.back());
  const auto first = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), middle) - time.begin());
  const std::size_t steps = time.size() - 1 - first;
  if (steps < slopes) return fit;
  const auto slope = [&](std::size_t a, std::size_t b) {
    return (square[b] - square[a]) / (2.0 * dimensions * (time[b] - time[a]));
  };
  fit.from = time[first];
  fit.value = slope(first, time.size() - 1);
  const auto error_of_parts = [&](std::size_t parts) {
    double squares = 0.0;
    for (std::size_t k = 0; k < parts; ++k) {
      const double part = slope(first + k * steps / parts, first + (k + 1) * steps / parts);
      squares += (part - fit.value) * (part - fit.value);
    }
    const auto n = static_cast<double>(parts);
    return std::sqrt(squares / (n - 1.0) / n);
  };
  fit.error = std::max(error_of_parts(slopes), error_of_parts(slopes / 2));
  return fit;
}

}  // namespace carom
