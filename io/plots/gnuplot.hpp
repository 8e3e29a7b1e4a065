// One figure of stacked panels with lines that carry their names at their ends, as gnuplot draws it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

// dashed: thin and grey, for a value to compare with. guide: likewise, and named beside its end within the panel. edge:
// of a band, thin.
enum class LineStyle : std::uint8_t { solid, points, dashed, guide, edge };

// A line; x and y have the same length, all finite, x ascending from 0 on.
struct Line {
  std::string name;
  std::vector<double> x, y;
  LineStyle style = LineStyle::solid;
};

// The area between two lines, behind all lines of the panel.
struct Band {
  std::vector<double> x, low, high;
  std::string colour;  // as gnuplot names it
};

struct Panel {
  std::string y_label;
  std::vector<Line> lines{};
  bool from_zero = false;     // the vertical axis includes 0
  bool wide_first = false;    // the first line is drawn wide, so that it shows where a later one covers it
  std::vector<Band> bands{};  // the first is the hindmost
};

struct Figure {
  std::string title;    // any text; control characters become blanks
  std::string x_label;  // under the lowest panel
  double x_end = 0.0;   // the horizontal axis goes from 0 to here; a line that ends earlier gets a cross there
  std::vector<Panel> panels;
  bool logarithmic = false;  // both axes; then all x and y are above 0, and the horizontal axis begins with the data
  const char* of_ended = ", gone";  // behind the name of a line that ends earlier
};

// How many points of a line of so many a figure has, at most.
std::size_t points_drawn(std::size_t points);

std::size_t letters_of(const std::string& text);

// Text (UTF-8) of so many letters at most (1 or more), the last of them "…" where some are left out.
std::string shortened(const std::string& text, std::size_t most);

// What a figure is called: "title: subject", or the subject alone. A long title is shortened, the subject stays.
std::string heading(const std::string& title, const char* subject);

// Writes the figure as SVG. Returns false, and writes nothing, where gnuplot is not installed. Throws RunError if it
// fails or the file cannot be written.
bool draw_svg(const Figure& figure, const std::string& path);

}  // namespace carom
