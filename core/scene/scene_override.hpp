// Applies changes by the command line (--set) to the TOML tree, before anything is checked.
#pragma once

#include "core/scene/scene_reader.hpp"

namespace carom {

// Sets change.key to change.value in the tree. Missing tables along the key are made; entries of lists must exist. A
// bare word is a string. Throws InputError, located at "--set key".
void apply_override(toml::table& root, const Override& change);

}  // namespace carom
