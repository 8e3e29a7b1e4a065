// Reads `motion = { ... }` of a side of the box or an inner wall.
#pragma once

#include <string_view>

#include "core/disks/side_motion.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The kind of motion that a table gives, and its value.
struct MotionKeys {
  SideMotion::Kind kind = SideMotion::Kind::none;
  std::string_view name;  // "velocity" or "vibrate"
  Vec2 value;             // length / time, or length
  double period = 0.0;    // time; of a vibration
  Dimension dimension() const { return kind == SideMotion::Kind::steady ? Dimension::speed : Dimension::length; }
};

// The table under `motion`. kind: its name in scene_keys.hpp. Precondition: the key exists. Throws InputError if it is
// not a table.
TableReader motion_table(const TableReader& owner, std::string_view kind);

// Throws InputError unless there is either a velocity, or a vibration with its period.
MotionKeys read_motion_keys(const TableReader& owner, const TableReader& motion);

}  // namespace carom
