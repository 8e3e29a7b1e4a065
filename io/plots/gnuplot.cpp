#include "io/plots/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/plots/gnuplot_run.hpp"

namespace carom {

namespace {

// Ten colours that can be told apart with all common kinds of colour blindness: black and the set of Okabe and Ito
// without its yellow, too pale for a line, completed by dark shades from the schemes of Paul Tol.
constexpr std::array<const char*, 10> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000",
                                              "#E69F00", "#56B4E9", "#332288", "#882255", "#888888"};

constexpr const char* grey = "#666666";

// More points than this on a line are more than pixels, and would only enlarge the file.
constexpr std::size_t most_points = 4000;

constexpr int width_pixels = 960;
constexpr double panel_pixels = 310.0, top_pixels = 56.0, bottom_pixels = 76.0;
constexpr double label_pixels = 19.0;  // least distance of two names
// Room for the numbers at the vertical axis, up to the length of -1.2e-12, and for its label; and for the names of
// lines, from their beginning: the usual width, or more if the longest name needs it.
constexpr double left_pixels = 130.0, usual_right_pixels = 125.0, name_begin_pixels = 27.0, letter_pixels = 9.2;
constexpr std::size_t title_letters = 92;  // in a line across the picture
constexpr std::size_t name_letters = 32;

struct Range {
  double low = 0.0, high = 1.0;
};

// In UTF-8 the other bytes of a letter are 10xxxxxx.
bool begins_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;
}

// A value as a height along the axis: its logarithm if the axis is logarithmic.
double shown(double y, bool logarithmic) {
  return logarithmic ? std::log10(y) : y;
}
double value_at(double height, bool logarithmic) {
  return logarithmic ? std::pow(10.0, height) : height;
}

Range vertical_range(const Panel& panel, bool logarithmic) {
  bool any = false;
  Range r;
  for (const Line& line : panel.lines) {
    for (const double value : line.y) {
      const double y = shown(value, logarithmic);
      r.low = any ? std::min(r.low, y) : y;
      r.high = any ? std::max(r.high, y) : y;
      any = true;
    }
  }
  if (panel.from_zero) r = {std::min(r.low, 0.0), std::max(r.high, 0.0)};
  if (!(r.high > r.low)) {
    const double room = r.high != 0.0 ? 0.1 * std::abs(r.high) : 1.0;
    r = {r.low - room, r.high + room};
  }
  const double margin = 0.06 * (r.high - r.low);
  return {panel.from_zero && r.low == 0.0 ? 0.0 : r.low - margin, r.high + margin};
}

// The number of values of a long line for which two points are drawn: the least and the greatest, so that no spike is
// lost.
std::size_t stretch_of(std::size_t points) {
  return points <= most_points ? 1 : (2 * points + most_points - 1) / most_points;
}

// Appends the points of a line, one a row.
void append_points(std::string& data, const Line& line) {
  const std::size_t n = line.x.size();
  const std::size_t stretch = stretch_of(n);
  const auto append = [&](std::size_t i) { fmt::format_to(std::back_inserter(data), "{} {}\n", line.x[i], line.y[i]); };
  for (std::size_t begin = 0; begin < n; begin += stretch) {
    const auto first = line.y.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = line.y.begin() + static_cast<std::ptrdiff_t>(std::min(begin + stretch, n));
    const auto [least, greatest] = std::minmax_element(first, last);
    const auto low = static_cast<std::size_t>(least - line.y.begin());
    const auto high = static_cast<std::size_t>(greatest - line.y.begin());
    append(std::min(low, high));
    if (low != high) append(std::max(low, high));
  }
}

// The same for a band: the lowest and the highest value of each stretch.
void append_points(std::string& data, const Band& band) {
  const std::size_t n = band.x.size();
  const std::size_t stretch = (n + most_points - 1) / most_points;
  for (std::size_t begin = 0; begin < n; begin += stretch) {
    const auto first = static_cast<std::ptrdiff_t>(begin),
               last = static_cast<std::ptrdiff_t>(std::min(begin + stretch, n));
    fmt::format_to(std::back_inserter(data), "{} {} {}\n", band.x[begin],
                   *std::min_element(band.low.begin() + first, band.low.begin() + last),
                   *std::max_element(band.high.begin() + first, band.high.begin() + last));
  }
}

// Heights for the names of the lines: at the ends of the lines, moved apart until no two overlap.
std::vector<double> label_heights(const Panel& panel, const Range& range, bool logarithmic) {
  const double distance = (range.high - range.low) * label_pixels / (0.9 * panel_pixels);
  std::vector<std::pair<double, std::size_t>> ends;
  for (std::size_t k = 0; k < panel.lines.size(); ++k) {
    const Line& line = panel.lines[k];
    if (line.style != LineStyle::guide) {
      ends.emplace_back(line.y.empty() ? range.low : shown(line.y.back(), logarithmic), k);
    }
  }
  std::sort(ends.begin(), ends.end());
  for (int round = 0; round < 200; ++round) {
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const double lacking = distance - (ends[k + 1].first - ends[k].first);
      if (lacking <= 0.0) continue;
      ends[k].first = std::max(ends[k].first - 0.5 * lacking, range.low);
      ends[k + 1].first = std::min(ends[k + 1].first + 0.5 * lacking, range.high);
    }
  }
  std::vector<double> heights(panel.lines.size());
  for (const auto& [height, k] : ends) heights[k] = value_at(height, logarithmic);
  return heights;
}

// The text in the margin beside a line's end.
std::string margin_name(const Figure& figure, const Line& line, double x_end) {
  const std::string name = shortened(line.name, name_letters);
  return line.x.back() >= x_end ? name : name + figure.of_ended;
}

double right_pixels(const Figure& figure, double x_end) {
  double pixels = usual_right_pixels;
  for (const Panel& panel : figure.panels) {
    for (const Line& line : panel.lines) {
      if (line.x.empty() || line.style == LineStyle::guide) continue;
      const auto letters = static_cast<double>(letters_of(margin_name(figure, line, x_end)));
      pixels = std::max(pixels, name_begin_pixels + letter_pixels * letters);
    }
  }
  return pixels;
}

// The name of a line in the margin, joined to the line's end. If the line ends early, a cross marks its end instead,
// since a stroke from there to the margin would look like data.
std::string name_commands(const Figure& figure, const Line& line, std::size_t tag, double height, double x_end,
                          const char* colour) {
  if (line.style == LineStyle::guide) {
    // Left of its end, above it, since there may be no room to the right; above its beginning if it ends at the margin.
    const bool at_end = line.x.back() < x_end;
    return fmt::format("set label {} {} at first {}, first {} {} textcolor rgb '{}'\n", tag, gnuplot_quoted(line.name),
                       at_end ? line.x.back() : line.x.front(), at_end ? line.y.back() : line.y.front(),
                       at_end ? "right offset -0.7,0.5" : "left offset 0.7,0.9", colour);
  }
  const bool to_the_end = line.x.back() >= x_end;
  std::string text = fmt::format("set label {} {} at graph 1.035, first {} left textcolor rgb '{}'\n", tag,
                                 gnuplot_quoted(margin_name(figure, line, x_end)), height, colour);
  const std::string end = fmt::format("first {}, first {}", line.x.back(), line.y.back());
  if (to_the_end) {
    text += fmt::format("set arrow {} from {} to graph 1.03, first {} nohead lc rgb '{}' lw 0.7\n", tag, end, height,
                        colour);
  } else {
    text += fmt::format("set label {} '' at {} point pt 2 ps 0.8 lc rgb '{}'\n", tag + 1000, end, colour);
  }
  return text;
}

// The style of a line for gnuplot: "with lines ..."; a single point, which would be invisible as a line, is drawn as a
// point.
std::string drawn_with(const Line& line, const char* colour, bool wide) {
  if (line.style == LineStyle::edge) return fmt::format("with lines lw 0.5 lc rgb '{}'", colour);
  if (line.style == LineStyle::points || line.x.size() == 1)
    return fmt::format("with points pt 7 ps 0.55 lc rgb '{}'", colour);
  if (line.style == LineStyle::solid) return fmt::format("with lines lw {} lc rgb '{}'", wide ? 3.0 : 1.6, colour);
  return fmt::format("with lines lw 1.2 dt (8,6) lc rgb '{}'", colour);
}

// The commands of one panel; `block` is the number of its first line in the data file.
std::string panel_commands(const Figure& figure, const Panel& panel, std::size_t block, double x_end) {
  const bool logarithmic = figure.logarithmic;
  const Range range = vertical_range(panel, logarithmic);
  const std::vector<double> heights = label_heights(panel, range, logarithmic);
  std::string text =
      fmt::format("unset label\nunset arrow\nset ylabel {}\nset yrange [{}:{}]\n", gnuplot_quoted(panel.y_label),
                  value_at(range.low, logarithmic), value_at(range.high, logarithmic));
  std::string plot;
  for (const Band& band : panel.bands) {
    if (!band.x.empty()) {
      plot += fmt::format("{} 'data' index {} using 1:2:3 with filledcurves lc rgb '{}'", plot.empty() ? "plot" : ",",
                          block, band.colour);
    }
    ++block;
  }
  for (std::size_t k = 0; k < panel.lines.size(); ++k) {
    const Line& line = panel.lines[k];
    const bool plain = line.style == LineStyle::solid || line.style == LineStyle::points;
    const char* const colour = plain ? colours[k % colours.size()] : grey;
    if (line.x.empty()) continue;
    text += name_commands(figure, line, k + 1, heights[k], x_end, colour);
    plot += fmt::format("{} 'data' index {} {}", plot.empty() ? "plot" : ",", block + k,
                        drawn_with(line, colour, panel.wide_first && k == 0));
  }
  if (plot.empty()) {
    text += fmt::format("set label 1 'no data' at graph 0.5, graph 0.5 center textcolor rgb '{}'\n", grey);
    plot = "plot NaN";
  }
  return text + plot + "\n";
}

// The beginning of the horizontal axis.
double x_begin(const Figure& figure, double x_end) {
  if (!figure.logarithmic) return 0.0;
  double least = 0.1 * x_end;
  for (const Panel& panel : figure.panels) {
    for (const Line& line : panel.lines) {
      if (!line.x.empty()) least = std::min(least, line.x.front());
    }
  }
  return least;
}

std::string script_of(const Figure& figure) {
  const double x_end = figure.x_end > 0.0 ? figure.x_end : 1.0;
  const auto panels = figure.panels.size();
  const double height = static_cast<double>(panels) * panel_pixels + top_pixels + bottom_pixels;
  std::string text = fmt::format(
      "set terminal svg size {},{} font 'sans-serif,15' linewidth 1 noenhanced background 'white'\n"
      "set output 'plot.svg'\n"
      "set multiplot layout {},1 title {} font 'sans-serif,18' margins {},{},{},{} spacing 0.06\n"
      "unset key\nset border 3 lc rgb '#555555'\nset tics nomirror out scale 0.5 textcolor rgb '#222222'\n"
      "set grid lc rgb '#dddddd' lt 1 lw 0.6\nset format '%g'\n{}set xrange [{}:{}]\n",
      width_pixels, height, panels, gnuplot_quoted(figure.title), left_pixels / width_pixels,
      1.0 - right_pixels(figure, x_end) / width_pixels, bottom_pixels / height, 1.0 - top_pixels / height,
      figure.logarithmic ? "set logscale xy\n" : "", x_begin(figure, x_end), x_end);
  std::size_t block = 0;
  for (std::size_t p = 0; p < panels; ++p) {
    if (p + 1 == panels) text += fmt::format("set xlabel {}\n", gnuplot_quoted(figure.x_label));
    text += panel_commands(figure, figure.panels[p], block, x_end);
    block += figure.panels[p].bands.size() + figure.panels[p].lines.size();
  }
  return text + "unset multiplot\n";
}

std::string data_of(const Figure& figure) {
  std::string data;
  for (const Panel& panel : figure.panels) {
    for (const Band& band : panel.bands) {
      append_points(data, band);
      data += band.x.empty() ? "NaN NaN NaN\n\n\n" : "\n\n";
    }
    for (const Line& line : panel.lines) {
      append_points(data, line);
      data += line.x.empty() ? "NaN NaN\n\n\n" : "\n\n";
    }
  }
  return data;
}

}  // namespace

std::size_t points_drawn(std::size_t points) {
  const std::size_t stretch = stretch_of(points);
  return stretch == 1 ? points : 2 * ((points + stretch - 1) / stretch);
}

std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_letter));
}

std::string shortened(const std::string& text, std::size_t most) {
  if (letters_of(text) <= most) return text;
  std::size_t end = 0;
  for (std::size_t letters = 0; end < text.size(); ++end) {
    if (begins_letter(text[end]) && ++letters == most) break;
  }
  return text.substr(0, end) + "…";
}

std::string heading(const std::string& title, const char* subject) {
  const std::string end(subject);
  return title.empty() ? end : fmt::format("{}: {}", shortened(title, title_letters - end.size() - 2), end);
}

bool draw_svg(const Figure& figure, const std::string& path) {
  return run_gnuplot(script_of(figure), data_of(figure), {{"plot.svg", path}});
}

}  // namespace carom
