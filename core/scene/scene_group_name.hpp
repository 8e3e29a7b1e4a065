// Names of groups in a scene file: giving one, and asking for the disks of one.
#pragma once

#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The value of "name" of a [[disks]] block; empty when absent. Throws InputError for what could not stand in a heading
// of series.csv: a name has 1 to 40 letters, digits, '_' and '-', and begins with a letter.
std::string read_group_name(const TableReader& group);

// The ids of the disks of the group that `key` of owner names. Throws InputError with the nearest name.
IdRange find_group(const TableReader& owner, std::string_view key, const std::string& name, const Scene& scene);

}  // namespace carom
