// Writes a scene as TOML.
#pragma once

#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/scene_text.hpp"

namespace carom {

// The scene as TOML with every default filled in; load_scene (core/load/scene_file.hpp) of it gives an equal scene.
std::string resolved_toml(const Scene& scene);

}  // namespace carom
