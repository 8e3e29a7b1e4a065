#include "io/tables/group_columns.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/measure/measured_disks.hpp"
#include "core/scene/drawn_velocities.hpp"

namespace carom {

std::vector<GroupColumn> group_column_kinds() {
  return {
      {"disks", true, "", "disks of the group in the box"},
      {"kinetic", false, "energy", "sum of m v^2 / 2 of its disks; nan for Brownian motion"},
      {"temperature", false, "energy",
       "mean kinetic energy of a disk of the group relative to their mean velocity, in a sheared box after the flow is "
       "subtracted; nan without disks and for Brownian motion"},
      {"vx", false, "length / time",
       "x component of their mean velocity, momentum over mass; nan without disks and for Brownian motion"},
      {"vy", false, "length / time", "y component of their mean velocity; nan as `vx_`"},
      {"x", false, "length", "x of their centre of mass, nan without disks; only if left and right are not periodic"},
      {"y", false, "length", "y of their centre of mass, nan without disks; only if bottom and top are not periodic"}};
}

namespace {

// A mean position along a periodic axis would depend on where the box is cut.
bool has_column(const Domain& box, const std::string& kind) {
  return kind == "x" ? !box.periodic_x() : kind == "y" ? !box.periodic_y() : true;
}

}  // namespace

GroupMeter::GroupMeter(const Scene& scene)
    : groups_(reported_groups(scene)), drawn_(velocities_are_drawn(scene)), box_(scene.box) {}

std::vector<GroupColumn> GroupMeter::columns() const {
  std::vector<GroupColumn> columns;
  for (const NamedGroup& group : groups_) {
    for (GroupColumn kind : group_column_kinds()) {
      if (!has_column(box_, kind.name)) continue;
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

std::vector<GroupMotion> GroupMeter::motions(const DisksInPieces& disks) const {
  using Members = std::span<const std::size_t>;
  std::vector<GroupTally> tallies(groups_.size());
  visit(disks, [&](std::size_t g, const Disks& d, Members members) { tallies[g].add(d, members); });
  visit(disks, [&](std::size_t g, const Disks& d, Members members) { tallies[g].add_thermal(d, members); });
  std::vector<GroupMotion> motions;
  for (const GroupTally& tally : tallies) motions.push_back(tally.motion());
  return motions;
}

std::vector<double> GroupMeter::row(const DisksInPieces& disks) const {
  std::vector<double> row;
  if (groups_.empty()) return row;
  std::vector<GroupMotion> all = motions(disks);
  if (box_.shear.acts()) {
    const std::vector<GroupMotion> in_flow = motions(DisksInFlow(disks, box_));
    for (std::size_t g = 0; g < all.size(); ++g) all[g].temperature = in_flow[g].temperature;
  }
  const auto of_velocities = [&](double v) { return drawn_ ? std::numeric_limits<double>::quiet_NaN() : v; };
  for (const GroupMotion& motion : all) {
    row.push_back(static_cast<double>(motion.disks));
    for (const double v : {motion.kinetic, motion.temperature, motion.velocity.x, motion.velocity.y}) {
      row.push_back(of_velocities(v));
    }
    if (!box_.periodic_x()) row.push_back(motion.centre.x);
    if (!box_.periodic_y()) row.push_back(motion.centre.y);
  }
  return row;
}

}  // namespace carom
