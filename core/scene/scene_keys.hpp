// Every table and every key that a scene may have: what the reader knows and checks, and what docs/scene.md says.
// A new key is one row in a keys_of_ file, and the line that reads it; a new table a row in scene_tables.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene_ranges.hpp"

namespace carom {

// What a value must be.
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
  special  // read by a function of its own, which checks it: lists, tables, texts with a meaning
};

struct SceneKey {
  std::string_view table;  // as in SceneTable
  std::string_view name;
  KeyKind kind;
  Dimension dimension;            // of numbers: the reader holds them against its range
  std::string_view initial;       // what holds where the key is absent: a value as in TOML where a reader asks for it,
                                  // "required", or words
  std::string_view meaning;       // Markdown, a sentence or two
  std::string_view example;       // as in TOML
  std::string_view allowed = {};  // what it may be, where kind does not say; Markdown, NAMES for names
  std::span<const std::string_view> names = {};  // of a choice
};

struct SceneTable {
  std::string_view name;     // "" is the file itself, "disks.radius" a table within [[disks]]; lists have no numbers
  std::string_view heading;  // in docs/scene.md
  std::string_view meaning;
};

std::span<const SceneTable> scene_tables();
std::span<const SceneKey> scene_keys();

// The key of this table, or nullptr.
const SceneKey* find_scene_key(std::string_view table, std::string_view name);

// Names of all keys of a table, in their order.
std::vector<std::string_view> key_names(std::string_view table);

// The table that a path leads to: "disks.0.radius" is "disks.radius".
std::string table_of_path(std::string_view path);

}  // namespace carom
