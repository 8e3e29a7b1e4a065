// Reading [[walls]]: inner walls.
#pragma once

#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// One table: from and to, or points. Throws InputError for anything that is no line of segments. That it lies in the
// box is for scene_check.hpp to say.
InnerWall read_wall(const SceneOrigin& origin, const std::string& path, const toml::table& table);

}  // namespace carom
