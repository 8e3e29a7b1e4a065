#include "tests/stability/map_frame.hpp"

#include <fmt/format.h>

namespace carom::stability {

namespace {

std::string tics(const char* axis, const Axis& a) {
  std::string list;
  for (std::size_t k = 0; k < a.labels.size(); ++k) {
    if (a.labels[k].empty()) continue;
    list += fmt::format("{}'{}' {}", list.empty() ? "" : ", ", a.labels[k], k);
  }
  return fmt::format("set {0}tics ({1})\nset {0}range [-0.5:{2}]\nset {0}label '{3}' offset {4}\n", axis, list,
                     static_cast<double>(a.labels.size()) - 0.5, a.title, *axis == 'y' ? "1.5,0" : "0,0");
}

}  // namespace

// One hue from pale to dark, shifted to violet so that the dark end can be distinguished; readable for the colour-blind
// and in grey.
std::string map_header(int width, int height) {
  return fmt::format(
      "set terminal svg size {},{} font 'sans-serif,14' linewidth 1 noenhanced background 'white'\n"
      "set output 'plot.svg'\nunset key\nset border 3 lc rgb '#555555'\n"
      "set tics nomirror out scale 0.4 textcolor rgb '#222222'\n"
      "set palette defined (0 '#eef4f8', 0.25 '#b9d6e8', 0.5 '#6aa5d0', 0.75 '#3f5fa8', 1 '#3b1455')\n"
      "set style fill solid noborder\n",
      width, height);
}

std::string map_axes(const std::string& title, const Axis& x, const Axis& y) {
  return fmt::format("set title '{}' font 'sans-serif,15'\n", title) + tics("x", x) + tics("y", y);
}

}  // namespace carom::stability
