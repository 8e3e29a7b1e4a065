#include "io/tables/side_columns.hpp"

#include <fmt/format.h>

#include "core/scene/scene_names.hpp"

namespace carom {

namespace {

bool gives_energy(const Domain& box, Side side) {
  return box.is_thermal(side) || box.moves(side);
}

}  // namespace

std::vector<std::string> side_column_names(const EnergySources& sources) {
  const Domain& box = sources.box;
  std::vector<std::string> names;
  for (const Side side : all_sides) {
    if (!gives_energy(box, side)) continue;
    const char* const name = box.moves(side) ? work_column.name : heat_column.name;
    names.push_back(fmt::format("{}_{}", name, side_names[static_cast<std::size_t>(side)]));
  }
  if (box.inner_walls_move) {
    for (const ColumnText& column : wall_columns) names.emplace_back(column.name);
  }
  if (sources.thermostat) names.emplace_back(thermostat_column.name);
  return names;
}

std::vector<double> side_column_values(const EnergySources& sources, const Counters& counters) {
  const Domain& box = sources.box;
  std::vector<double> values;
  for (const Side side : all_sides) {
    if (gives_energy(box, side)) values.push_back(counters.side_energy[static_cast<std::size_t>(side)]);
  }
  if (box.inner_walls_move)
    values.insert(values.end(), {counters.wall_work, counters.wall_push[0], counters.wall_push[1]});
  if (sources.thermostat) values.push_back(counters.thermostat_heat);
  return values;
}

}  // namespace carom
