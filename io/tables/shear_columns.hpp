// The columns of series.csv for a shear flow.
#pragma once

#include <array>

#include "io/tables/column_text.hpp"

namespace carom {

inline constexpr std::array<ColumnText, 4> shear_columns{{
    {"shear_stress", "energy / area",
     "-P_xy from the velocities of this row, relative to the flow, and all collisions since the row before"},
    {"viscosity", "mass / time", "`shear_stress` / `shear_rate`"},
    {"temperature", "energy", "mean kinetic energy of a disk relative to the flow g (y - height / 2)"},
    {"shear_work", "energy",
     "work of the moving images on the disks since the start; with elastic disks it becomes kinetic energy"},
}};

}  // namespace carom
