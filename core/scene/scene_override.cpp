#include "core/scene/scene_override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/base/input_message.hpp"
#include "core/scene/scene_tree.hpp"

namespace carom {

namespace {

// Is this a string that needs no quotes? It has letters, digits and the marks of file names only.
bool is_bare_word(std::string_view s) {
  return !s.empty() && std::all_of(s.begin(), s.end(), [](char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || c == '.' ||
           c == '/';
  });
}

std::vector<std::string_view> split_key(std::string_view key) {
  std::vector<std::string_view> segments;
  while (true) {
    const std::size_t dot = key.find('.');
    segments.push_back(key.substr(0, dot));
    if (dot == std::string_view::npos) return segments;
    key.remove_prefix(dot + 1);
  }
}

toml::array& list_entry_owner(toml::array& list, std::string_view segment, std::size_t& index,
                              const std::string& where) {
  const auto [end, error] = std::from_chars(segment.data(), segment.data() + segment.size(), index);
  if (error != std::errc() || end != segment.data() + segment.size() || index >= list.size()) {
    fail_input(where, fmt::format("no entry {} in a list of {}", in_quotes(segment), list.size()),
               "expected the number of an entry, from 0");
  }
  return list;
}

// The table or list below node that segment names. A missing table is made; but not a missing list, that is, if `next`
// is the number of an entry.
toml::node& descend(toml::node& node, std::string_view segment, std::string_view next, const std::string& where) {
  if (toml::table* table = node.as_table()) {
    if (table->get(segment) == nullptr) {
      if (!next.empty() && std::all_of(next.begin(), next.end(), is_digit)) {
        fail_input(where, fmt::format("no entry {}, as the scene has no {}", in_quotes(next), in_quotes(segment)),
                   "expected a list of the scene");
      }
      table->insert(segment, toml::table{});
    }
    return *table->get(segment);
  }
  if (toml::array* list = node.as_array()) {
    std::size_t index = 0;
    list_entry_owner(*list, segment, index, where);
    return (*list)[index];
  }
  fail_input(where, fmt::format("{} cannot be a key of {}", in_quotes(segment), type_name(node)),
             "expected a key of the scene");
}

// The text of what was expected instead of a value that cannot be read. (The shell removes the quotes around a text
// with blanks.)
std::string expected_value(const Override& change) {
  const std::string_view value = change.value;
  const bool text =
      value.find_first_of("\"'[]{}\n") == std::string_view::npos &&
      std::any_of(value.begin(), value.end(), [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); });
  if (!text) return "expected a value as in TOML";
  return fmt::format("expected a value as in TOML; text needs quotes of its own: '{}={}'", change.key,
                     in_quotes(value));
}

// The table { v = value }.
toml::table parse_value(const Override& change, const std::string& where) {
  const std::string& value = change.value;
  const bool large_seed = change.key == "seed" && !value.empty() && std::all_of(value.begin(), value.end(), is_digit);
  if (large_seed) return toml::table{{"v", value}};
  const std::string_view stray = stray_character(value);
  if (!stray.empty()) {
    fail_input(where, fmt::format("{} outside a string", in_quotes(stray)), "expected ASCII characters there");
  }
  try {
    toml::table parsed = toml::parse(std::string_view("v = " + value));
    if (parsed.size() == 1 && value.find('\n') == std::string::npos) return parsed;
  } catch (const toml::parse_error& e) {
    if (is_bare_word(value)) return toml::table{{"v", value}};
    fail_input(where, fmt::format("cannot read {}: {}", in_quotes(value), e.description()), expected_value(change));
  }
  fail_input(where, fmt::format("cannot read {}", in_quotes(value)), "expected one value as in TOML");
}

}  // namespace

void apply_override(toml::table& root, const Override& change) {
  const std::string where = fmt::format("--set {}", change.key);
  const std::vector<std::string_view> segments = split_key(change.key);
  if (std::find(segments.begin(), segments.end(), std::string_view{}) != segments.end()) {
    fail_input(where, "is not a key", "expected a key such as physics.restitution or disks.0.count");
  }
  toml::table value = parse_value(change, where);
  toml::node* owner = &root;
  for (std::size_t k = 0; k + 1 < segments.size(); ++k) owner = &descend(*owner, segments[k], segments[k + 1], where);
  if (toml::table* table = owner->as_table()) {
    table->insert_or_assign(segments.back(), *value.get("v"));
    return;
  }
  toml::array* list = owner->as_array();
  if (list == nullptr) descend(*owner, segments.back(), {}, where);  // throws
  std::size_t index = 0;
  list_entry_owner(*list, segments.back(), index, where);
  list->replace(list->begin() + static_cast<std::ptrdiff_t>(index), *value.get("v"));
}

}  // namespace carom
