// The motion of the disks of one group: centre of mass, its velocity, and the temperature relative to that.
#pragma once

#include <cstddef>
#include <span>

#include "core/disks/disks.hpp"

namespace carom {

struct GroupMotion {
  double kinetic = 0.0;  // sum of m v^2 / 2; energy
  double temperature =
      0.0;        // sum of m (v - V)^2 / 2, divided by the number of disks (k_B = 1); energy; NaN without disks
  Vec2 velocity;  // V: momentum over mass; length / time; NaN without disks
  Vec2 centre;    // centre of mass of the positions in the box, not unwrapped; length; NaN without disks
  Count disks = 0;
};

// The motion of disks that come in pieces. All pieces go through add(), then all once more through add_thermal(), since
// that needs the mean velocity. members: storage indices in order of id; pieces too must come in order of id, so that
// the sums have the same bits for any storage order.
class GroupTally {
 public:
  void add(const Disks& disks, std::span<const std::size_t> members);
  void add_thermal(const Disks& disks, std::span<const std::size_t> members);

  GroupMotion motion() const;

 private:
  Vec2 velocity() const { return {px_ / mass_, py_ / mass_}; }

  Count count_ = 0;
  double mass_ = 0.0, mx_ = 0.0, my_ = 0.0, px_ = 0.0, py_ = 0.0, kinetic_ = 0.0, thermal_ = 0.0;
};

}  // namespace carom
