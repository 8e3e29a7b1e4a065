// The scene from which a run of a sweep was made: files that it reads may have changed since.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/scene/scene.hpp"

namespace carom {

// Computed from the text of a resolved scene, which contains everything that was read from files.
std::size_t fingerprint(const std::string& scene_text);

// The resolved scene of the run in this folder, if the run has come to its end, or was stopped and left a checkpoint.
// Otherwise empty.
std::string scene_of_run(const std::filesystem::path& folder);

// Does this scene have the fingerprint? Another version may have written it in other words.
bool is_of_fingerprint(const std::string& scene_text, std::size_t print);

// The difference between the scene of a run and the one that it would have now, for "holds another sweep: ...".
std::string change_since(const std::string& scene_text, const Scene& now, const std::string& run);

}  // namespace carom
