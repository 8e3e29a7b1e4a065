// Changes made on the command line (--set), applied to the TOML tree before anything is checked.
#pragma once

#include "core/scene_reader.hpp"

namespace carom {

// Sets change.key to change.value in the tree; tables on the way that do not exist are made, entries of lists must
// exist. A value that is not TOML but a bare word counts as a string. Throws InputError, located at "--set key".
void apply_override(toml::table& root, const Override& change);

// Reads a scene's text. seed may be any unsigned 64-bit number although TOML integers end at 2^63 - 1: a larger one
// is kept as a string. Throws InputError, "name:line: ...", for a syntax error or a duplicate key.
toml::table parse_scene_tree(std::string_view text, const std::string& name);

}  // namespace carom
