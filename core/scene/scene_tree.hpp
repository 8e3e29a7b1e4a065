// From the text of a scene to its TOML tree.
#pragma once

#include "core/scene/scene_reader.hpp"

namespace carom {

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Parses a scene's text. seed may be any unsigned 64-bit number although TOML integers end at 2^63 - 1: a larger seed
// becomes a string. Throws InputError, "name:line: ...", for a syntax error or a duplicate key.
toml::table parse_scene_tree(std::string_view text, const std::string& name);

// The first character outside ASCII that is neither in a string nor in a comment; empty if there is none. TOML does not
// allow such characters; a minus sign from a word processor is the common case, and this gives a clearer message than
// the parser.
std::string_view stray_character(std::string_view text);

}  // namespace carom
