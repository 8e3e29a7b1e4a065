#include "core/measure/velocity_memory.hpp"

#include <cmath>
#include <limits>

#include "core/measure/vectors_by_id.hpp"

namespace carom {

namespace {
constexpr double no_velocity = std::numeric_limits<double>::quiet_NaN();
}

void begin_memory(VelocityMemory& memory, const DisksInPieces& disks) {
  memory.begun = true;
  keep_by_id(disks, memory.vx, memory.vy);
}

double velocity_autocorrelation(const VelocityMemory& memory, const DisksInPieces& disks) {
  double sum = 0.0;
  Count known = 0;
  disks.visit([&](const Disks& d) {
    for (const std::size_t i : by_id(d)) {
      const std::size_t id = d.id[i];
      if (id >= memory.vx.size() || std::isnan(memory.vx[id])) continue;
      sum += memory.vx[id] * d.vx[i] + memory.vy[id] * d.vy[i];
      ++known;
    }
  });
  return known > 0 ? sum / static_cast<double>(known) : no_velocity;
}

}  // namespace carom
