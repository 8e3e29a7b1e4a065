#include "core/measure/speed_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

void add_speeds(SpeedHistogram& h, const DisksInPieces& disks, double temperature, double max) {
  if (!(temperature > 0.0) || !std::isfinite(temperature)) return;
  const double bins_per_speed = static_cast<double>(h.counts.size()) / max;
  disks.visit([&](const Disks& d) {
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double v2 = d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i];
      const double u = std::sqrt(v2 * d.mass_of(i) / temperature);
      h.largest_seen = std::max(h.largest_seen, u);
      const double bin = u * bins_per_speed;
      if (bin < static_cast<double>(h.counts.size())) {
        ++h.counts[static_cast<std::size_t>(bin)];
      } else {
        ++h.beyond;
      }
    }
  });
  ++h.samples;
  h.temperature_sum += temperature;
}

double maxwell_share(double max, std::size_t bins, std::size_t k) {
  const double width = max / static_cast<double>(bins);
  const double low = width * static_cast<double>(k);
  const double high = width * static_cast<double>(k + 1);
  // exp(-a) - exp(-b) = exp(-a) (1 - exp(a - b)), without cancellation
  return -std::exp(-0.5 * low * low) * std::expm1(0.5 * (low * low - high * high));
}

}  // namespace carom
