// One figure of stacked panels with lines that carry their names at their ends, as gnuplot draws it.
#pragma once

#include <string>
#include <vector>

namespace carom {

// A line; x and y have the same length, all finite, x ascending from 0 on.
struct Line {
  std::string name;
  std::vector<double> x, y;
};

struct Panel {
  std::string y_label;
  std::vector<Line> lines;
  bool from_zero = false;   // the vertical axis includes 0
  bool wide_first = false;  // the first line is drawn wide, so that it shows where a later one covers it
};

struct Figure {
  std::string title;    // any text; control characters become blanks
  std::string x_label;  // under the lowest panel
  double x_end = 0.0;   // the horizontal axis goes from 0 to here; a line that ends earlier gets a cross there
  std::vector<Panel> panels;
};

// Writes the figure as SVG. Returns false, and writes nothing, where gnuplot is not installed. Throws RunError if it
// fails or the file cannot be written.
bool draw_svg(const Figure& figure, const std::string& path);

}  // namespace carom
