#include "io/movie/frame_legend.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "core/disks/obstacle_cells.hpp"
#include "core/scene/scene_names.hpp"
#include "io/files/shown_text.hpp"

namespace carom {

namespace {

constexpr double bar_width = 22.0;  // units
constexpr DiskId most_groups = 20;  // number in the list; there is no room for more

enum class Align { left, right, centre };

void select_font(cairo_t* c, double size, bool bold) {
  cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, size);
}

void draw_text(cairo_t* c, const std::string& text, double x, double y, double size, Align align, bool bold = false) {
  select_font(c, size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(c, text.c_str(), &extents);
  const double shift = align == Align::left ? 0.0 : align == Align::right ? 1.0 : 0.5;
  cairo_set_source_rgb(c, 0.13, 0.13, 0.13);
  cairo_move_to(c, x - shift * extents.x_advance, y);
  cairo_show_text(c, text.c_str());
}

// Removes the last character, in UTF-8.
void shorten(std::string& text) {
  while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xc0U) == 0x80U) text.pop_back();
  text.pop_back();
}

// Cuts text at a character boundary until it is at most `room` wide at this size. Half a character would be an error in
// Cairo, which then draws nothing more.
std::string fitting(cairo_t* c, std::string text, double size, double room, bool bold = false) {
  text = shown_text(text);
  // No picture has room for more, and measuring takes time for each letter.
  constexpr std::size_t most_bytes = 2000;
  while (text.size() > most_bytes) shorten(text);
  select_font(c, size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(c, text.c_str(), &extents);
  if (extents.x_advance <= room) return text;
  while (!text.empty() && extents.x_advance > room) {
    shorten(text);
    cairo_text_extents(c, (text + "…").c_str(), &extents);
  }
  return text + "…";
}

// Each kind of side has its own colour and dash, so that they also differ without colour.
void set_stroke(cairo_t* c, SideKind kind, double unit) {
  const std::array<double, 2> periodic_dash{10.0 * unit, 7.0 * unit};
  const std::array<double, 2> sink_dash{3.0 * unit, 5.0 * unit};
  switch (kind) {
    case SideKind::wall:
      cairo_set_source_rgb(c, 0.2, 0.2, 0.2);
      cairo_set_line_width(c, side_width * unit);
      cairo_set_dash(c, nullptr, 0, 0.0);
      break;
    case SideKind::periodic:
      cairo_set_source_rgb(c, 0.0, 0.447, 0.698);
      cairo_set_line_width(c, 0.5 * side_width * unit);
      cairo_set_dash(c, periodic_dash.data(), 2, 0.0);
      break;
    case SideKind::sink:
      cairo_set_source_rgb(c, 0.835, 0.369, 0.0);
      cairo_set_line_width(c, 1.5 * side_width * unit);
      cairo_set_dash(c, sink_dash.data(), 2, 0.0);
      break;
  }
}

void set_ink(cairo_t* c) {
  cairo_set_source_rgb(c, 0.13, 0.13, 0.13);
}

void set_colour(cairo_t* c, const Colour& colour) {
  cairo_set_source_rgb(c, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
}

// The number of intervals of the colour bar, 3 to 5, with the shortest numbers: 2.5 is divided into 0.5, 3 into 1.
int intervals_of(double low, double high) {
  const auto length = [&](int n) {
    std::size_t longest = 0;
    for (int k = 0; k <= n; ++k) {
      longest = std::max(longest, fmt::format("{:.4g}", low + (high - low) * k / n).size());
    }
    return longest;
  };
  int best = 5;
  for (const int n : {4, 3}) {
    if (length(n) < length(best)) best = n;
  }
  return best;
}

std::string time_stamp(double time, int decimals) {
  return decimals < 0 ? fmt::format("t = {:.4g}", time) : fmt::format("t = {:.{}f}", time, decimals);
}

void draw_colour_bar(cairo_t* c, const FrameStyle& style, const FrameLayout& layout) {
  const double u = layout.unit;
  const double x = layout.width - (right_margin - 34.0) * u;
  const double low = layout.height - bottom_margin * u;
  const bool one_value = !(style.high > style.low);
  const int rows = static_cast<int>(one_value ? bar_width * u : low - (top_margin + 30.0) * u);
  // Between its stops viridis() is linear, as the gradient is.
  const std::unique_ptr<cairo_pattern_t, void (*)(cairo_pattern_t*)> bar(
      cairo_pattern_create_linear(0.0, low, 0.0, low - rows), cairo_pattern_destroy);
  for (int stop = 0; stop <= viridis_stops; ++stop) {
    const double share = static_cast<double>(stop) / viridis_stops;
    const Colour colour = viridis(one_value ? 0.5 : share);
    cairo_pattern_add_color_stop_rgb(bar.get(), share, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
  }
  cairo_set_source(c, bar.get());
  cairo_rectangle(c, x, low - rows, bar_width * u, rows);
  cairo_fill(c);
  const std::string_view name = colour_names[static_cast<std::size_t>(style.look.colour)];
  draw_text(c, std::string(name), x, low - rows - 12.0 * u, 16.0 * u, Align::left);
  // If the scale was given or predicted, disks beyond an end have the end's colour. No coloured quantity is negative.
  const bool given = style.look.range.has_value();
  const bool open_low = given && style.low > 0.0, open_high = given || style.look.colour == ColourBy::speed;
  const int intervals = one_value ? 0 : intervals_of(style.low, style.high);
  for (int tick = 0; tick <= intervals; ++tick) {
    const double share = one_value ? 0.5 : static_cast<double>(tick) / intervals;
    const double y = low - share * rows;
    set_ink(c);
    cairo_set_line_width(c, 1.0 * u);
    cairo_move_to(c, x + bar_width * u, y);
    cairo_line_to(c, x + (bar_width + 5.0) * u, y);
    cairo_stroke(c);
    const char* const beyond = tick == 0 && open_low ? "≤ " : tick == intervals && open_high ? "≥ " : "";
    const double value = tick == intervals ? style.high : style.low + share * (style.high - style.low);
    draw_text(c, fmt::format("{}{:.4g}", one_value ? "" : beyond, value), x + (bar_width + 9.0) * u, y + 5.0 * u,
              14.0 * u, Align::left);
  }
}

void draw_groups(cairo_t* c, const FrameStyle& style, const FrameLayout& layout) {
  const double u = layout.unit;
  const double x = layout.width - (right_margin - 24.0) * u;
  const double room = layout.height - (top_margin + bottom_margin) * u;
  const auto fits = static_cast<DiskId>(std::max(1.0, room / (26.0 * u) - 1.0));
  const DiskId listed = std::min({style.groups, most_groups, fits});
  double y = top_margin * u;
  for (DiskId group = 0; group < listed; ++group, y += 26.0 * u) {
    const bool fixed = group < style.fixed_groups.size() && style.fixed_groups[group];
    set_colour(c, fixed ? obstacle_colour : group_colour(group));
    cairo_rectangle(c, x, y, 16.0 * u, 16.0 * u);
    cairo_fill(c);
    const bool named = group < style.group_names.size() && !style.group_names[group].empty();
    const std::string name = named ? style.group_names[group] : fmt::format("group {}", group);
    draw_text(c, fitting(c, name, 14.0 * u, (right_margin - 52.0) * u), x + 24.0 * u, y + 13.0 * u, 14.0 * u,
              Align::left);
  }
  if (listed < style.groups)
    draw_text(c, fmt::format("and {} more", style.groups - listed), x, y + 13.0 * u, 14.0 * u, Align::left);
}

// Is there a side, or an inner wall, of this kind?
bool shows(const FrameStyle& style, SideKind kind) {
  const auto is_such = [&](const Obstacle& o) {
    return (kind == SideKind::sink && o.kind == ObstacleKind::sink) ||
           (kind == SideKind::wall && o.kind == ObstacleKind::wall);
  };
  return style.box.has(kind) || std::any_of(style.obstacles.begin(), style.obstacles.end(), is_such);
}

// Names the kinds of side, unless all are walls.
void draw_kinds_of_side(cairo_t* c, const FrameStyle& style, const FrameLayout& layout) {
  if (!shows(style, SideKind::periodic) && !shows(style, SideKind::sink)) return;
  const double u = layout.unit;
  double x = left_margin * u;
  const double y = layout.height - 18.0 * u;
  for (const auto& [kind, name] : {std::pair{SideKind::wall, "wall"}, std::pair{SideKind::periodic, "periodic"},
                                   std::pair{SideKind::sink, "sink"}}) {
    if (!shows(style, kind)) continue;
    set_stroke(c, kind, u);
    cairo_move_to(c, x, y - 5.0 * u);
    cairo_line_to(c, x + 34.0 * u, y - 5.0 * u);
    cairo_stroke(c);
    cairo_set_dash(c, nullptr, 0, 0.0);
    draw_text(c, name, x + 42.0 * u, y, 14.0 * u, Align::left);
    x += 134.0 * u;
  }
}

}  // namespace

void draw_legends(cairo_t* c, const FrameStyle& style, const FrameLayout& layout) {
  const double u = layout.unit;
  const double room = layout.width - 2.0 * left_margin * u;
  draw_text(c, fitting(c, style.title, 22.0 * u, room, true), left_margin * u, 34.0 * u, 22.0 * u, Align::left, true);
  if (style.look.colour == ColourBy::group) {
    draw_groups(c, style, layout);
  } else {
    draw_colour_bar(c, style, layout);
  }
  draw_kinds_of_side(c, style, layout);
}

void draw_sides(cairo_t* c, const FrameStyle& style, const FrameLayout& layout, double time) {
  const double out = 0.5 * side_width * layout.unit;
  const Domain box = box_at(style.box, time);
  const auto inset = [&](Side side) { return box.place(side).inset; };
  const double left = layout.left + inset(Side::left) * layout.scale - out;
  const double right = layout.left + layout.across(box) - inset(Side::right) * layout.scale + out;
  const double low = layout.bottom - inset(Side::bottom) * layout.scale + out;
  const double high = layout.bottom - layout.upwards(box) + inset(Side::top) * layout.scale - out;
  for (const Side side : all_sides) {
    set_stroke(c, box.side(side), layout.unit);
    cairo_move_to(c, side == Side::right ? right : left, side == Side::top ? high : low);
    cairo_line_to(c, side == Side::left ? left : right, side == Side::bottom ? low : high);
    cairo_stroke(c);
  }
  cairo_set_dash(c, nullptr, 0, 0.0);
}

namespace {

void draw_segment(cairo_t* c, const FrameLayout& layout, double x, double y, const Obstacle& o) {
  cairo_move_to(c, layout.left + x * layout.scale, layout.bottom - y * layout.scale);
  cairo_line_to(c, layout.left + (x + o.dx) * layout.scale, layout.bottom - (y + o.dy) * layout.scale);
  cairo_stroke(c);
}

// Draws all images in the box of a wall that has moved around a periodic box, cut off at the box's sides.
void draw_images(cairo_t* c, const FrameStyle& style, const FrameLayout& layout, const Obstacle& o) {
  const Domain& box = style.box;
  cairo_save(c);
  cairo_rectangle(c, layout.left, layout.bottom, box.width * layout.scale, -box.height * layout.scale);
  cairo_clip(c);
  for (int kx = box.periodic_x() ? -1 : 0; kx <= (box.periodic_x() ? 1 : 0); ++kx) {
    for (int ky = box.periodic_y() ? -1 : 0; ky <= (box.periodic_y() ? 1 : 0); ++ky) {
      draw_segment(c, layout, o.x + kx * box.width, o.y + ky * box.height, o);
    }
  }
  cairo_restore(c);
}

}  // namespace

void draw_inner_walls(cairo_t* c, const FrameStyle& style, const FrameLayout& layout, double time) {
  for (const Obstacle& o : style.obstacles) {
    if (!o.is_segment()) continue;
    set_stroke(c, o.kind == ObstacleKind::sink ? SideKind::sink : SideKind::wall, layout.unit);
    if (o.moves) {
      draw_images(c, style, layout, at_time(o, style.wall_motions, time, style.box));
    } else {
      draw_segment(c, layout, o.x, o.y, o);
    }
  }
  cairo_set_dash(c, nullptr, 0, 0.0);
}

void draw_stamps(cairo_t* c, const FrameStyle& style, const FrameLayout& layout, std::size_t disks, double time) {
  const double u = layout.unit;
  const std::string count = disks == 1 ? "1 disk" : fmt::format("{} disks", disks);
  draw_text(c, time_stamp(time, style.time_decimals), left_margin * u, 62.0 * u, 18.0 * u, Align::left);
  draw_text(c, count, layout.width - right_margin * u, 62.0 * u, 18.0 * u, Align::right);
}

}  // namespace carom
