// One figure of stacked panels with lines that have their names at their ends, drawn by gnuplot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

// dashed: thin and grey, for a value to compare with. guide: also thin and grey, but named beside its end within the
// panel. edge: thin, the edge of a band.
enum class LineStyle : std::uint8_t { solid, points, dashed, guide, edge };

// A line; x and y have the same length, all finite, x ascending from 0 on.
struct Line {
  std::string name;
  std::vector<double> x, y;
  LineStyle style = LineStyle::solid;
};

// The area between two lines, drawn behind all lines of the panel.
struct Band {
  std::vector<double> x, low, high;
  std::string colour;  // a gnuplot colour
};

struct Panel {
  std::string y_label;
  std::vector<Line> lines{};
  bool from_zero = false;     // the vertical axis includes 0
  bool wide_first = false;    // the first line is wide, so that it is visible where a later one covers it
  std::vector<Band> bands{};  // the first one is the hindmost
};

struct Figure {
  std::string title;    // any text; control characters become blanks
  std::string x_label;  // under the lowest panel
  double x_end = 0.0;   // the horizontal axis goes from 0 to this; a line that ends earlier gets a cross there
  std::vector<Panel> panels;
  bool logarithmic = false;  // both axes; then all x and y are positive, and the horizontal axis begins with the data
  const char* of_ended = ", gone";  // added to the name of a line that ends earlier
};

// The number of points that a figure has of a line with this number, at most.
std::size_t points_drawn(std::size_t points);

std::size_t letters_of(const std::string& text);

// Text (UTF-8) cut to at most this number of letters (at least 1); the last one is "…" if some are left out.
std::string shortened(const std::string& text, std::size_t most);

// The title of a figure: "title: subject", or only the subject. A long title is shortened, the subject never.
std::string heading(const std::string& title, const char* subject);

// Writes the figure as SVG. Returns false, and writes nothing, if gnuplot is not installed. Throws RunError if it fails
// or the file cannot be written.
bool draw_svg(const Figure& figure, const std::string& path);

}  // namespace carom
