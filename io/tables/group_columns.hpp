// What series.csv and trajectory.h5 tell of each group that has a name.
#pragma once

#include <string>
#include <vector>

#include "core/disks/disks_in_pieces.hpp"
#include "core/measure/group_motion.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// A column's name is this one's, an underscore, and the group's. docs/scene.md has them from here.
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

  // Group by group; none where no block of the scene has a name.
  std::vector<GroupColumn> columns() const;

  bool empty() const { return groups_.empty(); }

  // The disks of one frame, a value a column. What is made of velocities is NaN for Brownian motion.
  std::vector<double> row(const DisksInPieces& disks) const;
  std::vector<double> row(const Disks& disks) const { return row(WholeDisks(disks, 0.0)); }

 private:
  // use(g, disks, members) for each group and each piece: those of its disks that are there, in order of id.
  template <class Use>
  void visit(const DisksInPieces& disks, const Use& use) const;
  std::vector<GroupMotion> motions(const DisksInPieces& disks) const;

  std::vector<NamedGroup> groups_;
  bool drawn_;
  Domain box_;
};

}  // namespace carom
