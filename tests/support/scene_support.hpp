// For tests of scene files: a valid scene, and the error message that a changed one gives.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/check.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"

namespace carom::test {

inline constexpr std::string_view sound_scene = R"(title = "gas"
seed = 7

[box]
width = 20.0
height = 10.0
left = "wall"
right = "wall"

[physics]
restitution = 0.5

[[disks]]
count = 3
positions = [[2, 2], [5, 5], [8, 2]]
velocities = { maxwell = 1.0 }
radius = 1.0
mass = 2.0

[run]
method = "pairwise"
dt = 0.01
t_end = 10.0
)";

// text with the only occurrence of `from` replaced by `to`.
inline std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  const std::size_t at = result.find(from);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + std::string(from));
  return result.replace(at, from.size(), to);
}

inline Scene scene_from(std::string_view text, const std::vector<Override>& overrides = {}) {
  return parse_scene(text, "gas.toml", "", overrides);
}

// The error message of reading the scene and making its disks; empty if there is none.
inline std::string complaint(std::string_view text, const std::vector<Override>& overrides = {},
                             const std::string& folder = "") {
  try {
    initial_state(parse_scene(text, "gas.toml", folder, overrides));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace carom::test
