#include "io/tables/rotation_columns.hpp"

#include "core/measure/invariants.hpp"

namespace carom {

std::vector<std::string> rotation_column_names(const Scene& scene) {
  std::vector<std::string> names;
  if (!scene.physics.surfaces.are_rough()) return names;
  for (const RotationColumn& column : rotation_columns) names.emplace_back(column.name);
  return names;
}

std::vector<double> rotation_column_values(const Disks& disks, const BlockRunner& run) {
  if (!disks.spins()) return {};
  const double energy = energy_of(disks, by_id(disks), 0.0, run).rotational;
  return {energy, disks.empty() ? 0.0 : 2.0 * energy / static_cast<double>(disks.size())};
}

}  // namespace carom
