// What series.csv tells of sides that give energy.
#pragma once

#include <string>
#include <vector>

#include "core/disks/domain.hpp"
#include "core/disks/state.hpp"

namespace carom {

// A column's name is this one's, an underscore, and the side's. docs/scene.md has them from here.
struct SideColumn {
  const char* name;
  const char* unit;
  const char* meaning;
};
inline constexpr SideColumn heat_column{
    "heat", "energy", "that a thermal side has given to the disks since the start; its slope is the flow of heat"};

inline constexpr SideColumn work_column{"work", "energy",
                                        "that a side that moves has done on the disks since the start"};

// The names of the columns of this box, none where no side is thermal or moves; and their values, in the same order.
std::vector<std::string> side_column_names(const Domain& box);
std::vector<double> side_column_values(const Domain& box, const Counters& counters);

}  // namespace carom
