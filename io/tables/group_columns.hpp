// The columns of series.csv and trajectory.h5 for groups with a name.
#pragma once

#include <string>
#include <vector>

#include "core/disks/disks_in_pieces.hpp"
#include "core/measure/group_motion.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The full name of a column is this name, an underscore, and the group's name. docs/scene.md is made from this list.
struct GroupColumn {
  std::string name;
  bool whole;  // a count
  const char* unit;
  const char* meaning;
};
std::vector<GroupColumn> group_column_kinds();

class GroupMeter {
 public:
  explicit GroupMeter(const Scene& scene);

  // The columns, group by group; none if no block of the scene has a name.
  std::vector<GroupColumn> columns() const;

  bool empty() const { return groups_.empty(); }

  // The values of one frame, one for each column. Quantities from velocities are NaN with Brownian motion.
  std::vector<double> row(const DisksInPieces& disks) const;
  std::vector<double> row(const Disks& disks) const { return row(WholeDisks(disks, 0.0)); }

 private:
  // Calls use(g, disks, members) for each group and each piece; members: its disks in the piece, in order of id.
  template <class Use>
  void visit(const DisksInPieces& disks, const Use& use) const;
  std::vector<GroupMotion> motions(const DisksInPieces& disks) const;

  std::vector<NamedGroup> groups_;
  bool drawn_;
  Domain box_;
};

}  // namespace carom
