// Every table and every key that a scene may have. The reader checks against these rows, and docs/scene.md is made from
// them. A new key needs one row in a keys_of_ file and the line that reads it; a new table a row in scene_tables.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene_ranges.hpp"

namespace carom {

// The kind of a value.
enum class KeyKind : std::uint8_t {
  number,         // any finite one
  positive,       // > 0
  non_negative,   // >= 0
  unit_interval,  // from 0 to 1
  count,          // a whole number, 0 or more
  ordinal,        // a whole number, 1 or more
  flag,           // true or false
  text,
  choice,  // one of names
  special  // read and checked by its own function: lists, tables, texts with a meaning
};

struct SceneKey {
  std::string_view table;  // as in SceneTable
  std::string_view name;
  KeyKind kind;
  Dimension dimension;            // of numbers: the reader checks its range
  std::string_view initial;       // what holds where the key is absent: a value as in TOML where a reader asks for it,
                                  // "required", or words
  std::string_view meaning;       // Markdown, a sentence or two
  std::string_view example;       // as in TOML
  std::string_view allowed = {};  // allowed values if kind does not tell; Markdown, with NAMES for names
  std::span<const std::string_view> names = {};  // of a choice
};

struct SceneTable {
  std::string_view
      name;  // "" for the file itself, "disks.radius" for a table within [[disks]], without the number of an entry
  std::string_view heading;  // in docs/scene.md
  std::string_view meaning;
};

std::span<const SceneTable> scene_tables();
std::span<const SceneKey> scene_keys();

// The key of this table, or nullptr.
const SceneKey* find_scene_key(std::string_view table, std::string_view name);

// The names of all keys of a table, in order.
std::vector<std::string_view> key_names(std::string_view table);

// The name of the table at a path: "disks.radius" for "disks.0.radius".
std::string table_of_path(std::string_view path);

}  // namespace carom
