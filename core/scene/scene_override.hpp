// Changes made on the command line (--set), applied to the TOML tree before anything is checked.
#pragma once

#include "core/scene/scene_reader.hpp"

namespace carom {

// Sets change.key to change.value in the tree; tables on the way that do not exist are made, entries of lists must
// exist. A value that is not TOML but a bare word counts as a string. Throws InputError, located at "--set key".
void apply_override(toml::table& root, const Override& change);

}  // namespace carom
