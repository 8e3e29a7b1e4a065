#include "io/tables/side_columns.hpp"

#include <fmt/format.h>

#include "core/scene/scene_names.hpp"

namespace carom {

std::vector<std::string> side_column_names(const Domain& box) {
  std::vector<std::string> names;
  for (const Side side : all_sides) {
    if (!box.is_thermal(side)) continue;
    names.push_back(fmt::format("{}_{}", heat_column.name, side_names[static_cast<std::size_t>(side)]));
  }
  return names;
}

std::vector<double> side_column_values(const Domain& box, const Counters& counters) {
  std::vector<double> values;
  for (const Side side : all_sides) {
    if (box.is_thermal(side)) values.push_back(counters.heat[static_cast<std::size_t>(side)]);
  }
  return values;
}

}  // namespace carom
