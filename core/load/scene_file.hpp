// Reading a scene from TOML and checking it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/override.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_frame.hpp"

namespace carom {

// Reads, applies the overrides, validates. Every list is read in (CSV files included), the box is known: with
// packing_fraction it is computed from the radii drawn. Throws InputError with one line, "file:line: key: what is
// wrong; what was expected" (an override is named "--set key"). frames reads what { frame = ... } asks for.
Scene load_scene(const std::string& path, const std::vector<Override>& overrides = {}, const FrameReader& frames = {});

// The same from text, for tests and fuzzing; name stands for the file in messages, relative CSV paths start at folder.
Scene parse_scene(std::string_view text, const std::string& name, const std::string& folder,
                  const std::vector<Override>& overrides = {}, const FrameReader& frames = {});

}  // namespace carom
