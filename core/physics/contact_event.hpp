// A contact found at the end of a drift: its disks (or disk and side), and the time since it began.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/types.hpp"
#include "core/disks/domain.hpp"
#include "core/physics/event_order.hpp"

namespace carom {

// Ids from here on are not disks: the partner of a wall contact is wall_partner(side), that of a contact with an
// obstacle obstacle_partner(its place in State::obstacles). Both are walls: they do not move.
inline constexpr DiskId first_obstacle_partner = 0xf0000000U;
inline constexpr DiskId first_wall_partner = 0xfffffff0U;
inline constexpr DiskId wall_partner(Side side) {
  return first_wall_partner + static_cast<DiskId>(side);
}
inline constexpr bool is_wall(DiskId partner) {
  return partner >= first_obstacle_partner;
}
inline constexpr DiskId obstacle_partner(std::size_t place) {
  return first_obstacle_partner + static_cast<DiskId>(place);
}
inline constexpr bool is_obstacle(DiskId partner) {
  return partner - first_obstacle_partner < first_wall_partner - first_obstacle_partner;
}
inline constexpr std::uint32_t obstacle_of(DiskId partner) {
  return partner - first_obstacle_partner;
}
inline constexpr Side wall_side(DiskId partner) {
  return static_cast<Side>(partner - first_wall_partner);
}

struct ContactEvent {
  double ago;            // time since the contact, 0 <= ago <= the step; the step if it is older or the pair separates
  DiskId id1, id2;       // id1 < id2; id2 may be a wall
  std::uint32_t i1, i2;  // storage indices of the disks (i2 unused for a wall)
};

// For event_order: the contact that began longest ago comes first.
inline constexpr double time_of(const ContactEvent& e) {
  return -e.ago;
}

}  // namespace carom
