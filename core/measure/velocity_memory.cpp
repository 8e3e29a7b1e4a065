#include "core/measure/velocity_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {
constexpr double no_velocity = std::numeric_limits<double>::quiet_NaN();
}

void begin_memory(VelocityMemory& memory, const DisksInPieces& disks) {
  memory.begun = true;
  // Ids begin without gaps: room that need not grow piece by piece.
  memory.vx.reserve(disks.size());
  memory.vy.reserve(disks.size());
  disks.visit([&](const Disks& d) {
    if (d.empty()) return;
    const std::size_t ids = *std::max_element(d.id.begin(), d.id.end()) + std::size_t{1};
    memory.vx.resize(ids, no_velocity);
    memory.vy.resize(ids, no_velocity);
    for (std::size_t i = 0; i < d.size(); ++i) {
      memory.vx[d.id[i]] = d.vx[i];
      memory.vy[d.id[i]] = d.vy[i];
    }
  });
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
