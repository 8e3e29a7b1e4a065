// The columns of series.csv and trajectory.h5 for the rotation of rough disks.
#pragma once

#include <string>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/scene/scene.hpp"
#include "io/tables/column_text.hpp"

namespace carom {

inline constexpr ColumnText rotation_columns[] = {
    {"rotational", "energy", "sum of I w^2 / 2, a part of `total`; only if disks are rough"},
    {"rotational_temperature", "energy",
     "mean of I w^2 of a disk, 0 without disks; only if disks are rough. The temperature of the motion of the centres "
     "is `kinetic` over `disks`"},
};

// The names of the columns, none if disks are smooth; and their values, in the same order.
std::vector<std::string> rotation_column_names(const Scene& scene);
std::vector<double> rotation_column_values(const DisksInPieces& disks, const BlockRunner& run);

}  // namespace carom
