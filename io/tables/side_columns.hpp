// The columns of series.csv for sides, inner walls and a thermostat that give energy.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "io/tables/column_text.hpp"

namespace carom {

// The full name of a column is this name, an underscore, and the side's name.
inline constexpr ColumnText heat_column{
    "heat", "energy", "energy given to the disks by this side since the start; its slope is the flow of heat"};

inline constexpr ColumnText work_column{"work", "energy", "work of this side on the disks since the start"};

// Columns of their own names.
inline constexpr ColumnText wall_columns[] = {
    {"wall_work", "energy", "work of moving inner walls on the disks since the start"},
    {"wall_push_x", "mass length / time",
     "x component of the momentum given to the disks by moving inner walls since the start"},
    {"wall_push_y", "mass length / time",
     "y component of the momentum given to the disks by moving inner walls since the start"},
};

inline constexpr ColumnText thermostat_column{"thermostat_heat", "energy",
                                              "energy given to the disks by the thermostat since the start"};

// The energy sources of a scene.
struct EnergySources {
  Domain box;
  bool thermostat = false;
  explicit EnergySources(const Scene& scene) : box(scene.box), thermostat(scene.physics.thermostat.acts()) {}
};

// The names of the columns for these sources, and their values, in the same order.
std::vector<std::string> side_column_names(const EnergySources& sources);
std::vector<double> side_column_values(const EnergySources& sources, const Counters& counters);

}  // namespace carom
