#define TOML_IMPLEMENTATION  // toml++ is compiled here, and nowhere else
#include "core/scene/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"

namespace carom {

namespace {

// The child of a table or of a list that a segment of a key path names, or nullptr.
const toml::node* child(const toml::node& node, std::string_view segment) {
  if (const toml::table* table = node.as_table()) return table->get(segment);
  const toml::array* list = node.as_array();
  if (list == nullptr) return nullptr;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(segment.data(), segment.data() + segment.size(), index);
  if (error != std::errc() || end != segment.data() + segment.size()) return nullptr;
  return list->get(index);
}

// The last key along a path that exists. line: its line in the file, or that of the last key along the path that has
// one. path: its own, if it has no line because an override made it.
struct LastKey {
  unsigned line = 1;
  std::string_view made;
};

LastKey last_key(const toml::table& root, std::string_view key) {
  const toml::node* node = &root;
  LastKey last;
  for (std::size_t at = 0; at < key.size();) {
    const std::size_t end = std::min(key.find('.', at), key.size());
    node = child(*node, key.substr(at, end - at));
    if (node == nullptr) break;
    const unsigned line = node->source().begin.line;
    last.made = line == 0 ? key.substr(0, end) : std::string_view{};
    if (line > 0) last.line = line;
    at = end + 1;
  }
  return last;
}

// Is path equal to prefix, or below it?
bool lies_at_or_below(std::string_view path, std::string_view prefix) {
  return path == prefix ||
         (path.size() > prefix.size() && path.substr(0, prefix.size()) == prefix && path[prefix.size()] == '.');
}

// The text of what was expected if the value breaks the bound of its kind; else empty.
std::string_view broken_bound(KeyKind kind, double value) {
  switch (kind) {
    case KeyKind::positive:
      return value > 0.0 ? "" : "expected a number above 0";
    case KeyKind::non_negative:
      return value >= 0.0 ? "" : "expected a number, 0 or more";
    case KeyKind::unit_interval:
      return value >= 0.0 && value <= 1.0 ? "" : "expected a number from 0 to 1";
    default:
      return "";
  }
}

// The default of a key, as a number.
template <class Number>
Number initial_number(const SceneKey& row) {
  Number value{};
  const char* const last = row.initial.data() + row.initial.size();
  const auto [end, error] = std::from_chars(row.initial.data(), last, value);
  if (error == std::errc() && end == last) return value;
  throw std::logic_error(fmt::format("scene_keys.cpp: {} of {} is no number", row.initial, row.name));
}

// Markdown as plain text.
std::string without_ticks(std::string_view markdown) {
  std::string text(markdown);
  std::erase(text, '`');
  return text;
}

// " (gravity is a key of [physics])" for a key that belongs to another table, even if a key of this table has a similar
// name (select, seed); empty if no table has it.
std::string where_it_belongs(std::string_view name) {
  std::string tables;
  for (const SceneTable& other : scene_tables()) {
    if (other.name.find('.') != std::string_view::npos || find_scene_key(other.name, name) == nullptr) continue;
    tables += tables.empty() ? "" : ", ";
    tables += other.name.empty() ? "the file itself, before all tables" : without_ticks(other.heading);
  }
  return tables.empty() ? "" : fmt::format(" ({} is a key of {})", name, tables);
}

// Is the magnitude of a decimal number, which is out of the range of a double, below 1?
bool is_below_one(const std::string& number) {
  const std::size_t e = number.find_first_of("eE");
  if (e != std::string::npos) return number.compare(e + 1, 1, "-") == 0;
  const std::size_t first = number.find_first_not_of("-0");
  return first != std::string::npos && number[first] == '.';
}

// "a string", or, for a number out of range (which --set passes on as a string), a text that says so.
std::string text_name(const std::string& text) {
  const char* const last = text.data() + text.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (text.empty() || end != last) return "a string";
  if (error == std::errc::result_out_of_range && is_below_one(text)) {
    return fmt::format("{}, too small for a double: the smallest is {:.2g}", text,
                       std::numeric_limits<double>::denorm_min());
  }
  if (error == std::errc::result_out_of_range) {
    return fmt::format("{}, too large for a double: the largest is {:.2g}", text, std::numeric_limits<double>::max());
  }
  const bool whole = text.find_first_not_of("0123456789", text[0] == '-' ? 1 : 0) == std::string::npos;
  constexpr double end_of_64_bits = 9223372036854775808.0;  // 2^63
  if (!whole || std::abs(value) < end_of_64_bits) return "a string";
  return fmt::format("{}, too large for the 64 bits of a whole number; write it as {:.17g}", text, value);
}

// Is this the width or height of a box whose size the scene gives by a packing fraction?
bool is_made_to_fit(const toml::table* root, std::string_view key) {
  if (root == nullptr || (key != "box.width" && key != "box.height")) return false;
  return root->at_path("box.packing_fraction") && !root->at_path(key);
}

constexpr double largest_exact_count = 9007199254740992.0;  // 2^53: above it not all whole numbers are doubles

}  // namespace

std::string SceneOrigin::where(std::string_view key) const {
  if (is_made_to_fit(root, key)) return fmt::format("{}: {} of the box", where("box.packing_fraction"), key.substr(4));
  for (auto it = overrides.rbegin(); it != overrides.rend(); ++it) {
    if (it->key == key) return fmt::format("--set {}", key);
    if (lies_at_or_below(key, it->key)) return fmt::format("--set {}: {}", it->key, key);
  }
  if (root == nullptr) return fmt::format("{}:1: {}", name, key);
  const LastKey last = last_key(*root, key);
  for (auto it = overrides.rbegin(); !last.made.empty() && it != overrides.rend(); ++it) {
    if (lies_at_or_below(it->key, last.made)) return fmt::format("--set {}: {}", it->key, key);
  }
  return fmt::format("{}:{}: {}", name, last.line, key);
}

void SceneOrigin::fail(std::string_view key, std::string_view what, std::string_view expected) const {
  fail_input(where(key), what, expected);
}

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return text_name(node.as_string()->get());
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

double as_number(const SceneOrigin& origin, const std::string& key, const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  const auto* number = node.as_floating_point();
  if (number == nullptr) origin.fail(key, fmt::format("is {}", type_name(node)), "expected a number");
  if (!std::isfinite(number->get())) origin.fail(key, fmt::format("is {}", number->get()), "expected a finite number");
  return number->get();
}

Count as_count(const SceneOrigin& origin, const std::string& key, const toml::node& node, Count least) {
  const std::string expected = fmt::format("expected a whole number, {} or more", least);
  if (const auto* integer = node.as_integer()) {
    if (integer->get() < static_cast<std::int64_t>(least))
      origin.fail(key, fmt::format("is {}", integer->get()), expected);
    return static_cast<Count>(integer->get());
  }
  const auto* number = node.as_floating_point();  // 1e6 is a float in TOML, and a fair way to write a count
  if (number == nullptr) origin.fail(key, fmt::format("is {}", type_name(node)), expected);
  const double value = number->get();
  if (!(value >= static_cast<double>(least) && value <= largest_exact_count) || value != std::floor(value)) {
    origin.fail(key, fmt::format("is {}", value), expected);
  }
  return static_cast<Count>(value);
}

bool as_flag(const SceneOrigin& origin, const std::string& key, const toml::node& node) {
  const auto* flag = node.as_boolean();
  if (flag == nullptr) origin.fail(key, fmt::format("is {}", type_name(node)), "expected true or false");
  return flag->get();
}

std::string as_text(const SceneOrigin& origin, const std::string& key, const toml::node& node) {
  const auto* text = node.as_string();
  if (text == nullptr) origin.fail(key, fmt::format("is {}", type_name(node)), "expected a string");
  return text->get();
}

const toml::array& as_list(const SceneOrigin& origin, const std::string& key, const toml::node& node,
                           std::string_view expected) {
  const toml::array* list = node.as_array();
  if (list == nullptr) origin.fail(key, fmt::format("is {}", type_name(node)), expected);
  return *list;
}

std::vector<double> as_numbers(const SceneOrigin& origin, const std::string& key, const toml::node& node) {
  const toml::array& list = as_list(origin, key, node, "expected a list of numbers");
  std::vector<double> numbers;
  numbers.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto* number = list[i].as_floating_point();
    const bool plain = number != nullptr && std::isfinite(number->get());  // avoids making a million key paths
    numbers.push_back(plain ? number->get() : as_number(origin, fmt::format("{}.{}", key, i), list[i]));
  }
  return numbers;
}

std::vector<Vec2> as_pairs(const SceneOrigin& origin, const std::string& key, const toml::node& node) {
  constexpr std::string_view expected = "expected two numbers in brackets";  // of an entry
  const toml::array& list = as_list(origin, key, node, "expected a list of [x, y]");
  std::vector<Vec2> pairs;
  pairs.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const toml::array* pair = list[i].as_array();
    const std::string entry = fmt::format("{}.{}", key, i);
    if (pair == nullptr) origin.fail(entry, fmt::format("is {}", type_name(list[i])), expected);
    if (pair->size() != 2) origin.fail(entry, "has " + counted(pair->size(), "number"), expected);
    pairs.push_back({as_number(origin, entry, (*pair)[0]), as_number(origin, entry, (*pair)[1])});
  }
  return pairs;
}

TableReader::TableReader(const SceneOrigin& origin, std::string path, const toml::table& table, std::string_view kind)
    : origin_(&origin), path_(std::move(path)), kind_(kind.empty() ? table_of_path(path_) : kind), table_(&table) {
  for (const auto& [name, node] : table) {
    if (find_scene_key(kind_, name.str()) == nullptr) {
      fail(name.str(), "unknown key", expected_one_of(key_names(kind_), name.str()) + where_it_belongs(name.str()));
    }
  }
}

std::string TableReader::key(std::string_view name) const {
  return path_.empty() ? std::string(name) : fmt::format("{}.{}", path_, name);
}

void TableReader::fail(std::string_view name, std::string_view what, std::string_view expected) const {
  origin_->fail(key(name), what, expected);
}

const SceneKey& TableReader::row(std::string_view name) const {
  const SceneKey* const found = find_scene_key(kind_, name);
  if (found == nullptr) throw std::logic_error(fmt::format("scene_keys.cpp has no key {} in {}", name, kind_));
  return *found;
}

const toml::node& TableReader::require(std::string_view name, std::string_view expected) const {
  const toml::node* node = find(name);
  if (node == nullptr) fail(name, "missing", expected);
  return *node;
}

std::optional<double> TableReader::number(std::string_view name) const {
  const SceneKey& key_row = row(name);
  const toml::node* node = find(name);
  if (node == nullptr) return std::nullopt;
  if (!node->is_number() && !key_row.allowed.empty()) {
    fail(name, fmt::format("is {}", type_name(*node)), "expected " + without_ticks(key_row.allowed));
  }
  const double value = as_number(*origin_, key(name), *node);
  const std::string_view broken = broken_bound(key_row.kind, value);
  if (!broken.empty()) {
    fail(name, fmt::format("is {}", value),
         key_row.allowed.empty() ? std::string(broken) : "expected " + without_ticks(key_row.allowed));
  }
  if (!in_range(key_row.dimension, value)) {
    fail(name, fmt::format("is {}", value), expected_range(key_row.dimension));
  }
  return value == 0.0 ? 0.0 : value;  // no -0, for messages
}

std::optional<Count> TableReader::count(std::string_view name) const {
  const Count least = row(name).kind == KeyKind::ordinal ? 1 : 0;
  const toml::node* node = find(name);
  return node == nullptr ? std::nullopt : std::optional(as_count(*origin_, key(name), *node, least));
}

std::optional<bool> TableReader::flag(std::string_view name) const {
  row(name);
  const toml::node* node = find(name);
  return node == nullptr ? std::nullopt : std::optional(as_flag(*origin_, key(name), *node));
}

std::optional<std::string> TableReader::text(std::string_view name) const {
  row(name);
  const toml::node* node = find(name);
  return node == nullptr ? std::nullopt : std::optional(as_text(*origin_, key(name), *node));
}

std::optional<std::size_t> TableReader::choice(std::string_view name) const {
  const std::optional<std::string> value = text(name);
  if (!value) return std::nullopt;
  const std::span<const std::string_view> known = row(name).names;
  const auto it = std::find(known.begin(), known.end(), *value);
  if (it == known.end()) fail(name, fmt::format("unknown name {}", in_quotes(*value)), expected_one_of(known, *value));
  return static_cast<std::size_t>(it - known.begin());
}

double TableReader::number_or_initial(std::string_view name) const {
  const std::optional<double> given = number(name);
  return given ? *given : initial_number<double>(row(name));
}

Count TableReader::count_or_initial(std::string_view name) const {
  const std::optional<Count> given = count(name);
  return given ? *given : initial_number<Count>(row(name));
}

bool TableReader::flag_or_initial(std::string_view name) const {
  return flag(name).value_or(row(name).initial == "true");
}

std::size_t TableReader::choice_or_initial(std::string_view name) const {
  const std::optional<std::size_t> given = choice(name);
  if (given) return *given;
  const SceneKey& key_row = row(name);
  for (std::size_t k = 0; k < key_row.names.size(); ++k) {
    if (key_row.initial == fmt::format("\"{}\"", key_row.names[k])) return k;
  }
  throw std::logic_error(fmt::format("scene_keys.cpp: {} is no name of {}", key_row.initial, name));
}

}  // namespace carom
