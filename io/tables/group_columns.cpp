#include "io/tables/group_columns.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/measure/group_motion.hpp"
#include "core/scene/drawn_velocities.hpp"

namespace carom {

std::vector<GroupColumn> group_column_kinds() {
  return {{"disks", true, "", "disks of the group in the box"},
          {"kinetic", false, "energy", "their sum of m v^2 / 2; nan for Brownian motion, here and below"},
          {"temperature", false, "energy",
           "mean kinetic energy of one of them, measured from their mean velocity; nan without disks, here and below"},
          {"vx", false, "length / time", "their mean velocity, momentum over mass"},
          {"vy", false, "length / time", "likewise"}};
}

GroupMeter::GroupMeter(const Scene& scene) : groups_(reported_groups(scene)), drawn_(velocities_are_drawn(scene)) {}

std::vector<GroupColumn> GroupMeter::columns() const {
  std::vector<GroupColumn> columns;
  for (const NamedGroup& group : groups_) {
    for (GroupColumn kind : group_column_kinds()) {
      kind.name += "_" + group.name;
      columns.push_back(kind);
    }
  }
  return columns;
}

std::vector<double> GroupMeter::row(const Disks& disks) const {
  std::vector<double> row;
  if (groups_.empty()) return row;
  const std::vector<std::size_t> order = by_id(disks);
  const auto place_of = [&](DiskId id) {
    return std::lower_bound(order.begin(), order.end(), id, [&](std::size_t i, DiskId k) { return disks.id[i] < k; });
  };
  const auto of_velocities = [&](double v) { return drawn_ ? std::numeric_limits<double>::quiet_NaN() : v; };
  for (const NamedGroup& group : groups_) {
    const std::span<const std::size_t> members(place_of(group.ids.first), place_of(group.ids.end));
    const GroupMotion motion = group_motion(disks, members);
    row.push_back(static_cast<double>(members.size()));
    for (const double v : {motion.kinetic, motion.temperature, motion.velocity.x, motion.velocity.y}) {
      row.push_back(of_velocities(v));
    }
  }
  return row;
}

}  // namespace carom
