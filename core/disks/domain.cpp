#include "core/disks/domain.hpp"

#include <cmath>

namespace carom {

double wrap_far(double c, double period) {
  c = std::fmod(c, period);
  if (c < 0.0) c += period;
  return c < period ? c : 0.0;
}

double wrap_sheared_far(double& x, double& y, double offset, const Domain& box) {
  const double within = wrap_far(y, box.height);
  const double rows = std::round((within - y) / box.height);
  y = within;
  x += rows * offset;
  return rows;
}

}  // namespace carom
