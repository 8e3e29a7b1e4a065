// Reads [[walls]]: inner walls.
#pragma once

#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// One table, with from and to, or points. Throws InputError for anything that is not a line of segments. Whether it
// lies in the box is checked by box_check.hpp.
InnerWall read_wall(const SceneOrigin& origin, const std::string& path, const toml::table& table);

}  // namespace carom
