#include "io/tables/group_columns.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/measure/group_motion.hpp"
#include "core/measure/measured_disks.hpp"
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

GroupMeter::GroupMeter(const Scene& scene, bool relative)
    : groups_(reported_groups(scene)), drawn_(velocities_are_drawn(scene)), box_(scene.box), relative_(relative) {}

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

template <class Use>
void GroupMeter::visit(const DisksInPieces& disks, const Use& use) const {
  disks.visit([&](const Disks& d) {
    const std::vector<std::size_t> order = by_id(d);
    const auto place_of = [&](DiskId id) {
      return std::lower_bound(order.begin(), order.end(), id, [&](std::size_t i, DiskId k) { return d.id[i] < k; });
    };
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const IdRange& ids = groups_[g].ids;
      use(g, d, std::span<const std::size_t>(place_of(ids.first), place_of(ids.end)));
    }
  });
}

std::vector<double> GroupMeter::row(const DisksInPieces& all) const {
  std::vector<double> row;
  if (groups_.empty()) return row;
  const DisksInFlow in_flow(all, box_);
  const DisksInPieces& disks = relative_ ? static_cast<const DisksInPieces&>(in_flow) : all;
  using Members = std::span<const std::size_t>;
  std::vector<GroupTally> tallies(groups_.size());
  visit(disks, [&](std::size_t g, const Disks& d, Members members) { tallies[g].add(d, members); });
  visit(disks, [&](std::size_t g, const Disks& d, Members members) { tallies[g].add_thermal(d, members); });
  const auto of_velocities = [&](double v) { return drawn_ ? std::numeric_limits<double>::quiet_NaN() : v; };
  for (const GroupTally& tally : tallies) {
    const GroupMotion motion = tally.motion();
    row.push_back(static_cast<double>(tally.disks()));
    for (const double v : {motion.kinetic, motion.temperature, motion.velocity.x, motion.velocity.y}) {
      row.push_back(of_velocities(v));
    }
  }
  return row;
}

}  // namespace carom
