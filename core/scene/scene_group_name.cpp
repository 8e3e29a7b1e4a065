#include "core/scene/scene_group_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/base/input_message.hpp"
#include "core/scene/disk_group.hpp"

namespace carom {

namespace {

constexpr std::size_t longest_name = 40;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool may_be_in_name(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace

std::string read_group_name(const TableReader& group) {
  if (group.find("name") == nullptr) return "";
  std::string name = group.text("name").value();
  if (name.empty() || name.size() > longest_name || !is_letter(name.front()) ||
      !std::all_of(name.begin(), name.end(), may_be_in_name)) {
    group.fail("name", fmt::format("is {}", in_quotes(name)),
               fmt::format("expected a letter, then letters, digits, _ or -, at most {} characters", longest_name));
  }
  if (name == sources_name) {
    group.fail("name", fmt::format("is {}, which names the disks of all [[sources]]", in_quotes(name)),
               "expected another name");
  }
  return name;
}

IdRange find_group(const TableReader& owner, std::string_view key, const std::string& name, const Scene& scene) {
  const std::vector<NamedGroup> named = named_groups(scene);
  std::vector<std::string_view> names;
  for (const NamedGroup& group : named) {
    if (group.name == name) return group.ids;
    names.push_back(group.name);
  }
  const std::string what = fmt::format("unknown group {}", in_quotes(name));
  if (names.empty()) owner.fail(key, what, "expected the name of a [[disks]] block, and none has one");
  owner.fail(key, what, expected_one_of(names, name));
}

}  // namespace carom
