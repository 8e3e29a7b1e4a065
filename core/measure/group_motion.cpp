#include "core/measure/group_motion.hpp"

#include <limits>

namespace carom {

GroupMotion group_motion(const Disks& d, std::span<const std::size_t> members) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  GroupMotion motion;
  double mass = 0.0, px = 0.0, py = 0.0;
  for (const std::size_t i : members) {
    const double m = d.mass_of(i);
    mass += m;
    px += m * d.vx[i];
    py += m * d.vy[i];
    motion.kinetic += 0.5 * m * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
  }
  if (members.empty()) {
    motion.temperature = nothing;
    motion.velocity = {nothing, nothing};
    return motion;
  }
  motion.velocity = {px / mass, py / mass};
  double thermal = 0.0;
  for (const std::size_t i : members) {
    const double ux = d.vx[i] - motion.velocity.x;
    const double uy = d.vy[i] - motion.velocity.y;
    thermal += 0.5 * d.mass_of(i) * (ux * ux + uy * uy);
  }
  motion.temperature = thermal / static_cast<double>(members.size());
  return motion;
}

}  // namespace carom
