// Typed access to the tables of a scene file, with the place of every key for messages. Only the scene_*.cpp files
// that walk the TOML tree include this.
#pragma once

// One translation unit (scene_reader.cpp) holds toml++ compiled; the others see declarations only.
#define TOML_HEADER_ONLY 0
#define TOML_ENABLE_FORMATTERS 0
// toml++ 3.3 asserts things that a malformed file can break ("[" and then a stray character) although the code behind
// the assertion reports them properly; with NDEBUG and clang it even assumes them. So neither: no assertion at all.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "core/scene/override.hpp"
#include "core/scene/scene_frame.hpp"
#include "core/scene/scene_keys.hpp"

namespace carom {

// Where a scene came from. Key paths are written as in --set: "physics.gravity", "disks.0.radius".
struct SceneOrigin {
  std::string name;    // of the file, as messages show it
  std::string folder;  // where relative CSV paths start
  const toml::table* root = nullptr;
  std::vector<Override> overrides;
  FrameReader frames;  // how to read a frame of a trajectory; empty where there is no way to

  // "file:line: key", or "--set key" where an override made it. A missing key has the line of the table it should be
  // in.
  std::string where(std::string_view key) const;

  // Throws InputError: where(key), what is wrong, what was expected.
  [[noreturn]] void fail(std::string_view key, std::string_view what, std::string_view expected) const;
};

// "a string", "a list", ...: how messages call the type of a value.
std::string_view type_name(const toml::node& node);

// One value of the type asked for; key is its path. Each throws InputError for another type; numbers must be finite.
double as_number(const SceneOrigin& origin, const std::string& key, const toml::node& node);
Count as_count(const SceneOrigin& origin, const std::string& key, const toml::node& node);
bool as_flag(const SceneOrigin& origin, const std::string& key, const toml::node& node);
std::string as_text(const SceneOrigin& origin, const std::string& key, const toml::node& node);
const toml::array& as_list(const SceneOrigin& origin, const std::string& key, const toml::node& node,
                           std::string_view expected);
std::vector<double> as_numbers(const SceneOrigin& origin, const std::string& key, const toml::node& node);
// A list of [x, y].
std::vector<Vec2> as_pairs(const SceneOrigin& origin, const std::string& key, const toml::node& node);

// One table and its key path ("" for the root). What its keys are and may be, scene_keys.hpp says. Missing keys read as
// nullopt.
class TableReader {
 public:
  // Throws InputError when the table has a key that it should not have. kind: its name in scene_keys.hpp, where the
  // path does not tell.
  TableReader(const SceneOrigin& origin, std::string path, const toml::table& table, std::string_view kind = {});

  std::string key(std::string_view name) const;  // its full path
  const toml::node* find(std::string_view name) const { return table_->get(name); }
  // Throws InputError when the key is missing.
  const toml::node& require(std::string_view name, std::string_view expected) const;

  // Held against the bounds and the range of the key's row.
  std::optional<double> number(std::string_view name) const;
  std::optional<Count> count(std::string_view name) const;
  std::optional<bool> flag(std::string_view name) const;
  std::optional<std::string> text(std::string_view name) const;
  // One of the row's names, as its index.
  std::optional<std::size_t> choice(std::string_view name) const;

  // The same, or what the row says of an absent key.
  double number_or_initial(std::string_view name) const;
  Count count_or_initial(std::string_view name) const;
  bool flag_or_initial(std::string_view name) const;
  std::size_t choice_or_initial(std::string_view name) const;

  [[noreturn]] void fail(std::string_view name, std::string_view what, std::string_view expected) const;
  const SceneOrigin& origin() const { return *origin_; }

 private:
  // The row of a key that is read. Throws std::logic_error where scene_keys.cpp has none.
  const SceneKey& row(std::string_view name) const;

  const SceneOrigin* origin_;
  std::string path_;
  std::string kind_;
  const toml::table* table_;
};

}  // namespace carom
