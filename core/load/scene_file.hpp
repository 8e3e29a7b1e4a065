// Reading a scene from TOML and checking it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/override.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_frame.hpp"

namespace carom {

// Reads a scene, applies the overrides and validates it. Every list has been read in (CSV files included), and the box
// is known: with packing_fraction it is computed from the radii drawn. Throws InputError with one line, "file:line:
// key: what is wrong; what was expected" (an override is named "--set key"). frames reads the frame of { frame = ... }.
Scene load_scene(const std::string& path, const std::vector<Override>& overrides = {}, const FrameReader& frames = {});

// The same from text, for tests and fuzzing. name: the file in messages; relative CSV paths start at folder.
Scene parse_scene(std::string_view text, const std::string& name, const std::string& folder,
                  const std::vector<Override>& overrides = {}, const FrameReader& frames = {});

}  // namespace carom
