#include "tests/stability/case.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/scene/scene_reader.hpp"
#include "core/scene/scene_tree.hpp"

namespace carom::stability {

namespace {

[[noreturn]] void fail(const std::string& path, const toml::node& at, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}", path, at.source().begin.line, what));
}

// All other keys are errors: a bound that is not read would never fail.
void check_keys(const std::string& path, const toml::table& table, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : table) {
    bool found = false;
    for (const std::string_view name : known) found = found || key.str() == name;
    if (!found) fail(path, value, fmt::format("unknown key \"{}\"", std::string(key.str())));
  }
}

// "set" = { "run.dt" = "0.1" }: the same as on the command line.
std::vector<Override> read_changes(const std::string& path, const toml::table* table) {
  std::vector<Override> changes;
  if (table == nullptr) return changes;
  for (const auto& [key, value] : *table) {
    if (!value.is_string()) fail(path, value, "expected the new value in quotes, as after --set");
    changes.push_back({std::string(key.str()), value.as_string()->get()});
  }
  return changes;
}

Check read_check(const std::string& path, const toml::table& table) {
  check_keys(path, table, {"what", "is", "like", "bound", "share", "exact", "pairwise", "rollback"});
  Check check;
  check.what = table["what"].value_or(std::string());
  check.expected = table["is"].value_or(0.0);
  check.like_exact = table["like"].value_or(std::string()) == "exact";
  check.relative = table.contains("share");
  check.bound = table[check.relative ? "share" : "bound"].value_or(0.0);
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    if (const auto own = table[method].value<double>()) check.own[method] = *own;
  }
  return check;
}

Takes read_takes(const std::string& path, const toml::table& table) {
  const toml::node* node = table.get("takes");
  if (node == nullptr) return Takes::less;
  if (node->value_or(std::string()) == "seconds") return Takes::seconds;
  if (node->value_or(std::string()) == "minutes") return Takes::minutes;
  fail(path, *node, "expected \"seconds\" or \"minutes\"");
}

Case read_case(const std::string& path, const toml::table& table) {
  check_keys(path, table,
             {"name", "title", "scene", "set", "set_exact", "set_pairwise", "set_rollback", "check", "right",
              "most_steps", "takes", "every_step"});
  Case c;
  c.name = table["name"].value_or(std::string());
  c.title = table["title"].value_or(std::string());
  c.scene = table["scene"].value_or(c.name);
  c.changes = read_changes(path, table["set"].as_table());
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    c.own_changes[method] = read_changes(path, table["set_" + method].as_table());
  }
  const toml::array* checks = table["check"].as_array();
  if (c.name.empty() || c.title.empty() || checks == nullptr) fail(path, table, "expected name, title and check");
  for (const toml::node& node : *checks) {
    if (!node.is_table()) fail(path, node, "expected a table { what = ..., is = ..., bound = ... }");
    c.checks.push_back(read_check(path, *node.as_table()));
  }
  if (const toml::array* right = table["right"].as_array()) {
    for (const toml::node& node : *right) c.right.push_back(node.value_or(std::string()));
  }
  c.most_steps = static_cast<Count>(table["most_steps"].value_or(std::int64_t{0}));
  c.takes = read_takes(path, table);
  c.every_step = table["every_step"].value_or(false);
  return c;
}

}  // namespace

double Check::bound_of(const std::string& method) const {
  const auto it = own.find(method);
  return it != own.end() ? it->second : bound;
}

std::vector<Case> read_cases(const std::string& path) {
  const toml::table tree = parse_scene_tree(read_text_file(path, path), path);
  const toml::array* list = tree["case"].as_array();
  if (list == nullptr) throw InputError(path + ": expected tables [[case]]");
  std::vector<Case> cases;
  for (const toml::node& node : *list) cases.push_back(read_case(path, *node.as_table()));
  return cases;
}

}  // namespace carom::stability
