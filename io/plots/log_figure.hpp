// A page of small panels with logarithmic axes, drawn by gnuplot: curves of errors, whose names are above the panel,
// where there is no curve.
#pragma once

#include <string>
#include <vector>

namespace carom {

struct LogPoint {
  double x = 0.0, y = 0.0;  // > 0
  double error = 0.0;       // standard error of y; 0 draws no bar
  bool bound = false;       // y is only an upper bound: drawn open, and not joined to its neighbours
};

// The style of a curve sets its colour and symbol, the same in every panel.
struct LogCurve {
  int style = 0;                 // 0, 1, 2, ...
  std::string name;              // above the panel, in the curve's colour; not shown if empty
  std::vector<LogPoint> points;  // in the order in which they are joined
  bool faint = false;            // thin and dashed: a second quantity of the same method
  bool name_left = false;  // at the left end of the first line of names; other names have a line each at the right
};

struct LogPanel {
  std::string title;
  std::string x_label, y_label;  // empty: none
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0;
  std::vector<LogCurve> curves;
  std::string remark;  // below the names, grey
};

// Rows of panels under a heading.
struct LogSection {
  std::string heading;
  std::vector<LogPanel> panels;
};

struct LogFigure {
  std::string title;
  std::string caption;  // one line or more under everything
  std::size_t columns = 4;
  std::vector<LogSection> sections;
};

// Writes the same picture as SVG and PNG. Returns false, and writes nothing, where gnuplot is not installed. Throws
// RunError if it fails or a file cannot be written.
bool draw_log_figure(const LogFigure& figure, const std::string& svg_path, const std::string& png_path);

}  // namespace carom
