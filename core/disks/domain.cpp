#include "core/disks/domain.hpp"

#include <cmath>

namespace carom {

double wrap_far(double c, double period) {
  c = std::fmod(c, period);
  if (c < 0.0) c += period;
  return c < period ? c : 0.0;
}

}  // namespace carom
