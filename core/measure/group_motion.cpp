#include "core/measure/group_motion.hpp"

#include <limits>

namespace carom {

void GroupTally::add(const Disks& d, std::span<const std::size_t> members) {
  count_ += members.size();
  for (const std::size_t i : members) {
    const double m = d.mass_of(i);
    mass_ += m;
    mx_ += m * d.x[i];
    my_ += m * d.y[i];
    px_ += m * d.vx[i];
    py_ += m * d.vy[i];
    kinetic_ += 0.5 * m * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
  }
}

void GroupTally::add_thermal(const Disks& d, std::span<const std::size_t> members) {
  const Vec2 mean = velocity();
  for (const std::size_t i : members) {
    const double ux = d.vx[i] - mean.x;
    const double uy = d.vy[i] - mean.y;
    thermal_ += 0.5 * d.mass_of(i) * (ux * ux + uy * uy);
  }
}

GroupMotion GroupTally::motion() const {
  GroupMotion motion;
  motion.kinetic = kinetic_;
  motion.disks = count_;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  motion.temperature = count_ > 0 ? thermal_ / static_cast<double>(count_) : nothing;
  motion.velocity = count_ > 0 ? velocity() : Vec2{nothing, nothing};
  motion.centre = count_ > 0 ? Vec2{mx_ / mass_, my_ / mass_} : Vec2{nothing, nothing};
  return motion;
}

}  // namespace carom
