// What a run of a sweep was made from: files that its scene reads may be others now.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/scene/scene.hpp"

namespace carom {

// Of the text of a resolved scene, which has all that was read from files.
std::size_t fingerprint(const std::string& scene_text);

// The resolved scene of the run in this folder: of one that has come to its end, or that was stopped and left a
// checkpoint to go on from. Empty where there is neither.
std::string scene_of_run(const std::filesystem::path& folder);

// Is this the scene that has the fingerprint? Another version may have written it in other words.
bool is_of_fingerprint(const std::string& scene_text, std::size_t print);

// How the scene of a run differs from the one that it would have now, for "holds another sweep: ...".
std::string change_since(const std::string& scene_text, const Scene& now, const std::string& run);

}  // namespace carom
