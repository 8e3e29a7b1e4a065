#include "io/tables/rotation_columns.hpp"

#include "core/measure/blocked_tally.hpp"

namespace carom {

std::vector<std::string> rotation_column_names(const Scene& scene) {
  std::vector<std::string> names;
  if (!scene.physics.surfaces.are_rough()) return names;
  for (const ColumnText& column : rotation_columns) names.emplace_back(column.name);
  return names;
}

std::vector<double> rotation_column_values(const DisksInPieces& disks, const BlockRunner& run) {
  BlockedTally sum;
  disks.visit(
      [&](const Disks& d) { sum.add(by_id(d), run, [&](std::size_t i) { return rotational_energy_of(d, i); }); });
  const double energy = sum.value();
  return {energy, disks.size() == 0 ? 0.0 : 2.0 * energy / static_cast<double>(disks.size())};
}

}  // namespace carom
