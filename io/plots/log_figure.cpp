#include "io/plots/log_figure.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <sstream>

#include "io/plots/gnuplot_run.hpp"

namespace carom {

namespace {

// Vermilion, blue and green of Okabe and Ito, which can be told apart with all common kinds of colour blindness, and
// black; symbols differ too.
constexpr std::array<const char*, 4> series_colours{"#D55E00", "#0072B2", "#009E73", "#000000"};
constexpr std::array<int, 4> filled{5, 7, 13, 9};  // square, circle, diamond, triangle
constexpr std::array<int, 4> open{4, 6, 12, 8};
constexpr const char* note_grey = "#666666";

// Pixels of the SVG.
constexpr double panel_width = 262.0, panel_height = 270.0;
constexpr double left_margin = 58.0, right_margin = 10.0, top_margin = 68.0, bottom_margin = 44.0;
constexpr double title_below = 14.0, names_below = 31.0, line_height = 14.0, title_height = 40.0, heading_height = 34.0,
                 caption_height = 44.0;

std::size_t rows_of(const LogSection& section, std::size_t columns) {
  return (section.panels.size() + columns - 1) / columns;
}

struct Page {
  double width = 0.0, height = 0.0;
};

Page page_of(const LogFigure& figure) {
  Page page{static_cast<double>(figure.columns) * panel_width, title_height + caption_height};
  for (const LogSection& section : figure.sections) {
    page.height += heading_height + static_cast<double>(rows_of(section, figure.columns)) * panel_height;
  }
  return page;
}

std::size_t style_of(int style) {
  return static_cast<std::size_t>(style) % series_colours.size();
}

void add_block(std::string& data, const std::vector<LogPoint>& points, bool bounds) {
  bool any = false;
  for (const LogPoint& p : points) {
    if (p.bound != bounds) continue;
    // A bar that reaches below zero ends far down, outside the panel.
    const double low = p.error < p.y ? p.y - p.error : 1e-9 * p.y;
    fmt::format_to(std::back_inserter(data), "{} {} {} {}\n", p.x, p.y, low, p.y + p.error);
    any = true;
  }
  data += any ? "\n\n" : "NaN NaN NaN NaN\n\n\n";
}

// The commands that draw one curve, whose two blocks of data (values, bounds) begin at `block`.
std::string plot_commands(const LogCurve& curve, std::size_t block) {
  const std::size_t s = style_of(curve.style);
  const double width = curve.faint ? 1.0 : 1.6, size = curve.faint ? 0.42 : 0.62;
  std::string text = fmt::format("'data' index {} using 1:2 with lines lw {} dt {} lc rgb '{}'", block, width,
                                 curve.faint ? "(6,4)" : "solid", series_colours[s]);
  text += fmt::format(", 'data' index {} using 1:2:3:4 with yerrorbars pt {} ps {} lw 0.8 lc rgb '{}'", block,
                      curve.faint ? open[s] : filled[s], size, series_colours[s]);
  text += fmt::format(", 'data' index {} using 1:2 with points pt {} ps {} lw 1 lc rgb '{}'", block + 1, open[s], size,
                      series_colours[s]);
  return text;
}

// Title, names and remark of the panel with this upper left corner, from top to bottom.
std::string head_commands(const LogPanel& panel, const Page& page, double left, double top) {
  const double from = (left + left_margin) / page.width;
  const double to = (left + panel_width - right_margin) / page.width;
  const auto label = [&](const std::string& words, double x, double down, const char* side, const std::string& look) {
    return fmt::format("set label {} at screen {}, screen {} {} {} front\n", gnuplot_quoted(words), x,
                       1.0 - (top + down) / page.height, side, look);
  };
  std::string text = label(panel.title, from, title_below, "left", "font ',12' noenhanced textcolor rgb '#000000'");
  double down = names_below;
  for (const LogCurve& curve : panel.curves) {
    if (curve.name.empty()) continue;
    const std::string look = fmt::format("font ',10' textcolor rgb '{}'", series_colours[style_of(curve.style)]);
    if (curve.name_left) {
      text += label(curve.name, from, names_below, "left", look);
    } else {
      text += label(curve.name, to, down, "right", look);
      down += line_height;
    }
  }
  if (panel.remark.empty()) return text;
  return text + label(panel.remark, to, down, "right", fmt::format("font ',10' textcolor rgb '{}'", note_grey));
}

// Ticks at every decade; if there are many, at every second or third.
std::string ticks(const char* axis, double low, double high) {
  const double decades = std::log10(high / low);
  const int step = decades > 9.0 ? 3 : decades > 4.5 ? 2 : 1;
  std::string text = fmt::format("set {}tics (", axis);
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  bool any = false;
  for (int k = last; k >= first; --k) {
    const bool labelled = (last - k) % step == 0;
    text += any ? ", " : "";
    text += labelled ? fmt::format("'10^{{{}}}' 1e{}", k, k) : fmt::format("'' 1e{} 1", k);
    any = true;
  }
  return text + ")\n";
}

std::string panel_commands(const LogPanel& panel, const Page& page, double left, double top, std::size_t& block) {
  const auto x = [&](double pixels) { return pixels / page.width; };
  const auto y = [&](double pixels) { return 1.0 - pixels / page.height; };
  std::string text = "unset label\n";
  text += fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\n"
      "set bmargin at screen {}\n",
      x(left + left_margin), x(left + panel_width - right_margin), y(top + top_margin),
      y(top + panel_height - bottom_margin));
  text += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", panel.x_low, panel.x_high, panel.y_low, panel.y_high);
  text += ticks("x", panel.x_low, panel.x_high) + ticks("y", panel.y_low, panel.y_high);
  text += fmt::format("set xlabel {} offset 0,0.5\nset ylabel {} offset 1.2,0\n", gnuplot_quoted(panel.x_label),
                      gnuplot_quoted(panel.y_label));
  text += head_commands(panel, page, left, top);
  std::string plot;
  for (const LogCurve& curve : panel.curves) {
    plot += (plot.empty() ? "plot " : ", ") + plot_commands(curve, block);
    block += 2;
  }
  return text + (plot.empty() ? "plot NaN" : plot) + "\n";
}

std::string caption_lines(const LogFigure& figure, const Page& page) {
  std::string text, line;
  std::istringstream lines(figure.caption);
  for (double height = caption_height - 14.0; std::getline(lines, line); height -= 16.0) {
    text += fmt::format("set label {} at screen 0.012, screen {} left font ',11' noenhanced\n", gnuplot_quoted(line),
                        height / page.height);
  }
  return text;
}

std::string page_commands(const LogFigure& figure, const Page& page) {
  std::string text = fmt::format(
      "set multiplot\nunset key\nset logscale xy\nset bars 0\nset border 3 lc rgb '#555555' lw 0.8\n"
      "set tics nomirror out scale 0.4 textcolor rgb '#222222' font ',10.5'\n"
      "set grid lc rgb '#e6e6e6' lt 1 lw 0.5\nset xlabel font ',11'\nset ylabel font ',11'\n"
      "set label 1000 {} at screen 0.012, screen {} left font ',17' noenhanced\n",
      gnuplot_quoted(figure.title), 1.0 - 22.0 / page.height);
  // Headings and caption belong to the page: they are drawn once, with the first panel, as numbered labels that stay.
  std::string page_labels = caption_lines(figure, page);
  double top = title_height;
  for (const LogSection& section : figure.sections) {
    page_labels += fmt::format("set label {} at screen 0.012, screen {} left font ',14' noenhanced\n",
                               gnuplot_quoted(section.heading), 1.0 - (top + 18.0) / page.height);
    top += heading_height + static_cast<double>(rows_of(section, figure.columns)) * panel_height;
  }
  text += page_labels;
  text +=
      "set border 0\nunset tics\nset lmargin at screen 0\nset rmargin at screen 1\nset tmargin at screen 1\n"
      "set bmargin at screen 0\nset xrange [1:2]\nset yrange [1:2]\nplot NaN\n"
      "set border 3 lc rgb '#555555' lw 0.8\n"
      "set tics nomirror out scale 0.4 textcolor rgb '#222222' font ',10.5'\n";
  top = title_height;
  std::size_t block = 0;
  for (const LogSection& section : figure.sections) {
    top += heading_height;
    for (std::size_t k = 0; k < section.panels.size(); ++k) {
      const double left = static_cast<double>(k % figure.columns) * panel_width;
      const double down = static_cast<double>(k / figure.columns) * panel_height;
      text += panel_commands(section.panels[k], page, left, top + down, block);
    }
    top += static_cast<double>(rows_of(section, figure.columns)) * panel_height;
  }
  return text + "unset multiplot\nunset output\n";
}

}  // namespace

bool draw_log_figure(const LogFigure& figure, const std::string& svg_path, const std::string& png_path) {
  const Page page = page_of(figure);
  std::string data;
  for (const LogSection& section : figure.sections) {
    for (const LogPanel& panel : section.panels) {
      for (const LogCurve& curve : panel.curves) {
        add_block(data, curve.points, false);
        add_block(data, curve.points, true);
      }
    }
  }
  const std::string commands = page_commands(figure, page);
  // The PNG has twice the pixels, for print and for sharp screens.
  const std::string script = fmt::format(
      "set terminal svg size {0},{1} font 'sans-serif,11' linewidth 1 enhanced background 'white'\n"
      "set output 'chart.svg'\n{2}reset\n"
      "set terminal pngcairo size {3},{4} font 'sans-serif,11' fontscale 1.5 linewidth 2 pointscale 2 enhanced "
      "background 'white'\nset output 'chart.png'\n{2}",
      page.width, page.height, commands, 2.0 * page.width, 2.0 * page.height);
  return run_gnuplot(script, data, {{"chart.svg", svg_path}, {"chart.png", png_path}});
}

}  // namespace carom
