// Where the disks of one group are and how they move: their mean place and velocity, and the temperature around it.
#pragma once

#include <cstddef>
#include <span>

#include "core/disks/disks.hpp"

namespace carom {

struct GroupMotion {
  double kinetic = 0.0;      // sum of m v^2 / 2; energy
  double temperature = 0.0;  // sum of m (v - V)^2 / 2 over the number of disks (k_B = 1); energy; NaN without any
  Vec2 velocity;             // V: momentum over mass; length / time; NaN without any
  Vec2 centre;               // of mass, of places as they are in the box; length; NaN without any
  Count disks = 0;
};

// The motion of disks that come in pieces: all of them by add(), and then all once more by add_thermal(), as only then
// their mean velocity is known. members: storage indices in order of id, over all pieces too, so that the sums have the
// same bits in any storage order.
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
