#include "run/library/scene_of_struct.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/input_message.hpp"
#include "core/load/scene_file.hpp"

namespace carom {

namespace {

template <std::size_t n>
std::string_view name_in(const std::array<std::string_view, n>& names, int number, const char* what) {
  if (number < 0 || static_cast<std::size_t>(number) >= n) {
    fail_input(what, fmt::format("is {}", number), fmt::format("expected 0 to {}", n - 1));
  }
  return names[static_cast<std::size_t>(number)];
}

std::string_view side_name(int side, const char* what) {
  return name_in<3>({"wall", "periodic", "sink"}, side, what);
}

// A key and its number as TOML, with all bits; empty for 0, which means not given.
std::string line(const char* key, double value) {
  if (value == 0.0) return "";
  if (!std::isfinite(value)) fail_input(key, fmt::format("is {}", value), "expected a finite number");
  return fmt::format("{} = {:.17e}\n", key, value);
}

// A single number if gravity points along -y, as one would write it in a file.
std::string gravity_line(const carom_scene& told) {
  if (told.gravity_x == 0.0) return line("gravity", told.gravity);
  for (const double g : {told.gravity_x, told.gravity}) {
    if (!std::isfinite(g)) fail_input("gravity", fmt::format("is {}", g), "expected a finite number");
  }
  return fmt::format("gravity = [{:.17e}, {:.17e}]\n", told.gravity_x, -told.gravity);
}

}  // namespace

// The scene is made through its text, so that it is checked like a file, and can be read back from a checkpoint.
Scene scene_of_struct(const carom_scene& told) {
  std::string text = fmt::format("seed = \"{}\"\n[box]\n", told.seed);
  text += line("width", told.width) + line("height", told.height);
  text += fmt::format("left = \"{}\"\nright = \"{}\"\nbottom = \"{}\"\ntop = \"{}\"\n", side_name(told.left, "left"),
                      side_name(told.right, "right"), side_name(told.bottom, "bottom"), side_name(told.top, "top"));
  text += fmt::format("wall_restitution = {:.17e}\n", told.wall_restitution) + "[physics]\n";
  text += gravity_line(told) + line("diffusion", told.diffusion);
  text += fmt::format("restitution = {:.17e}\n", told.restitution);
  text += "[[disks]]\ncount = 0\npositions = \"random\"\nradius = 1.0\nmass = 1.0\n[run]\n";
  text += fmt::format("method = \"{}\"\n", name_in<3>({"exact", "pairwise", "rollback"}, told.method, "method"));
  text += line("dt", told.dt) + line("t_end", told.t_end);
  return parse_scene(text, "scene", "");
}

}  // namespace carom
