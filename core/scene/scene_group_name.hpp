// Names of groups in a scene file: reads the name of a group, and finds the group of a name.
#pragma once

#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The value of "name" of a [[disks]] block; empty when absent. Throws InputError unless it has 1 to 40 letters, digits,
// '_' and '-' and begins with a letter, as headings of series.csv need.
std::string read_group_name(const TableReader& group);

// The ids of the disks of the group that `key` of owner names. Throws InputError with the nearest name.
IdRange find_group(const TableReader& owner, std::string_view key, const std::string& name, const Scene& scene);

}  // namespace carom
