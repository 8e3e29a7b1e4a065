// Shared by both maps: the look of a map of cells as a gnuplot script.
#pragma once

#include <string>
#include <vector>

namespace carom::stability {

struct Axis {
  std::string title;
  std::vector<std::string> labels;  // one for each cell; empty: no label
};

// Terminal, output and the settings shared by the panels. Cells are at 0, 1, 2, ... along both axes.
std::string map_header(int width, int height);

// The axes of a panel with one cell for each label.
std::string map_axes(const std::string& title, const Axis& x, const Axis& y);

}  // namespace carom::stability
