// Reading what the four sides of the box do, the keys left to top of [box].
#pragma once

#include "core/disks/domain.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// Each is a name, or a table that says more of a wall. Throws InputError.
void read_sides(const TableReader& box, Domain& domain);

}  // namespace carom
