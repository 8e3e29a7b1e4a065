// What both maps share: the look of a map of cells as a gnuplot script.
#pragma once

#include <string>
#include <vector>

namespace carom::stability {

struct Axis {
  std::string title;
  std::vector<std::string> labels;  // of the cells, one each; empty: none
};

// Terminal, output and the settings that panels share. Cells lie at 0, 1, 2, ... along both axes.
std::string map_header(int width, int height);

// Axes of a panel with a cell for each label.
std::string map_axes(const std::string& title, const Axis& x, const Axis& y);

}  // namespace carom::stability
