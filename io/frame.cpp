#include "io/frame.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/check.hpp"
#include "io/disk_raster.hpp"

// fontconfig keeps what it has found until the program ends, and LeakSanitizer would fail every test that draws text.
#if defined(__SANITIZE_ADDRESS__)
#define CAROM_LEAKS_ARE_LOOKED_FOR
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CAROM_LEAKS_ARE_LOOKED_FOR
#endif
#endif
#ifdef CAROM_LEAKS_ARE_LOOKED_FOR
extern "C" {
const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";
}
const char* __lsan_default_options();
const char* __lsan_default_options() {
  return "print_suppressions=0";  // they would go to standard error, which tests read
}
}
#endif

namespace carom {

namespace {

// All in pixels. The longer side of the box fills its limit; the margins hold title, time, legend and colour bar.
constexpr double widest_box = 960.0, highest_box = 800.0;
constexpr double narrowest_picture = 420.0, lowest_picture = 300.0;  // of the part without margins
constexpr double left_margin = 28.0, right_margin = 132.0, top_margin = 78.0, bottom_margin = 48.0;
constexpr double side_width = 4.0;  // of a wall's line
constexpr double bar_width = 22.0;

// A few disks far smaller than a pixel would be invisible in a large box; they are drawn as large as this.
constexpr std::size_t few_disks = 5000;
constexpr double smallest_of_few = 1.6;

int even(double pixels) {
  return 2 * static_cast<int>(std::ceil(0.5 * pixels));
}

enum class Align { left, right, centre };

void draw_text(cairo_t* c, const std::string& text, double x, double y, double size, Align align, bool bold = false) {
  cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, size);
  cairo_text_extents_t extents;
  cairo_text_extents(c, text.c_str(), &extents);
  const double shift = align == Align::left ? 0.0 : align == Align::right ? 1.0 : 0.5;
  cairo_set_source_rgb(c, 0.13, 0.13, 0.13);
  cairo_move_to(c, x - shift * extents.x_advance, y);
  cairo_show_text(c, text.c_str());
}

// Cuts text at a character boundary until it is at most `room` wide at this size.
std::string fitting(cairo_t* c, std::string text, double size, double room) {
  cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
  cairo_set_font_size(c, size);
  cairo_text_extents_t extents;
  cairo_text_extents(c, text.c_str(), &extents);
  if (extents.x_advance <= room) return text;
  while (!text.empty() && extents.x_advance > room) {
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xc0U) == 0x80U) text.pop_back();
    text.pop_back();
    cairo_text_extents(c, (text + "…").c_str(), &extents);
  }
  return text + "…";
}

// Each kind of side has its own colour and dash, so that they differ without colour too.
void set_stroke(cairo_t* c, SideKind kind) {
  static constexpr double periodic_dash[] = {10.0, 7.0};
  static constexpr double sink_dash[] = {3.0, 5.0};
  switch (kind) {
    case SideKind::wall:
      cairo_set_source_rgb(c, 0.2, 0.2, 0.2);
      cairo_set_line_width(c, side_width);
      cairo_set_dash(c, nullptr, 0, 0.0);
      break;
    case SideKind::periodic:
      cairo_set_source_rgb(c, 0.0, 0.447, 0.698);
      cairo_set_line_width(c, 0.5 * side_width);
      cairo_set_dash(c, periodic_dash, 2, 0.0);
      break;
    case SideKind::sink:
      cairo_set_source_rgb(c, 0.835, 0.369, 0.0);
      cairo_set_line_width(c, 1.5 * side_width);
      cairo_set_dash(c, sink_dash, 2, 0.0);
      break;
  }
}

// How many intervals of the colour bar, 3 to 5, give the shortest numbers: 2.5 is cut into 0.5, 3 into 1.
int intervals_of(double fastest) {
  int best = 5;
  for (const int n : {4, 3}) {
    if (fmt::format("{:.4g}", fastest / n).size() < fmt::format("{:.4g}", fastest / best).size()) best = n;
  }
  return best;
}

std::string time_stamp(double time, int decimals) {
  return decimals < 0 ? fmt::format("t = {:.4g}", time) : fmt::format("t = {:.{}f}", time, decimals);
}

}  // namespace

void FramePainter::Free::operator()(_cairo* context) const {
  cairo_destroy(context);
}
void FramePainter::Free::operator()(_cairo_surface* surface) const {
  cairo_surface_destroy(surface);
}

FramePainter::FramePainter(FrameStyle style) : style_(std::move(style)) {
  scale_ = std::min(widest_box / style_.box.width, highest_box / style_.box.height);
  const double box_width = style_.box.width * scale_, box_height = style_.box.height * scale_;
  const double inner_width = std::max(box_width, narrowest_picture);
  const double inner_height = std::max(box_height, lowest_picture);
  width_ = even(left_margin + inner_width + right_margin);
  height_ = even(top_margin + inner_height + bottom_margin);
  left_ = std::round(left_margin + 0.5 * (inner_width - box_width));
  bottom_ = std::round(top_margin + 0.5 * (inner_height + box_height));
  background_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_));
  image_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_));
  draw_background();
}

FramePainter::~FramePainter() = default;

FramePainter::Context FramePainter::context_of(const Surface& surface) const {
  return Context(cairo_create(surface.get()));
}

const unsigned char* FramePainter::pixels() const {
  return cairo_image_surface_get_data(image_.get());
}

std::size_t FramePainter::bytes() const {
  return static_cast<std::size_t>(cairo_image_surface_get_stride(image_.get())) * static_cast<std::size_t>(height_);
}

void FramePainter::draw_background() {
  const Context context = context_of(background_);
  cairo_t* const c = context.get();
  cairo_set_source_rgb(c, 1.0, 1.0, 1.0);
  cairo_paint(c);
  draw_text(c, fitting(c, style_.title, 22.0, width_ - 2.0 * left_margin), left_margin, 34.0, 22.0, Align::left, true);
  draw_colour_bar(c);
  draw_legend(c);
}

// Outside the box, so that a disk at the wall is seen whole.
void FramePainter::draw_side(cairo_t* c, Side side) const {
  const double out = 0.5 * side_width;
  const double left = left_ - out, right = left_ + style_.box.width * scale_ + out;
  const double low = bottom_ + out, high = bottom_ - style_.box.height * scale_ - out;
  set_stroke(c, style_.box.side(side));
  cairo_move_to(c, side == Side::right ? right : left, side == Side::top ? high : low);
  cairo_line_to(c, side == Side::left ? left : right, side == Side::bottom ? low : high);
  cairo_stroke(c);
}

void FramePainter::draw_colour_bar(cairo_t* c) const {
  const double x = width_ - right_margin + 34.0;
  const double height = height_ - top_margin - bottom_margin - 30.0;
  const double low = height_ - bottom_margin;
  const int rows = static_cast<int>(height);
  for (int row = 0; row < rows; ++row) {
    const Colour colour = viridis((row + 0.5) / rows);
    cairo_set_source_rgb(c, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
    cairo_rectangle(c, x, low - row - 1.0, bar_width, 1.0);
    cairo_fill(c);
  }
  draw_text(c, "speed", x, low - rows - 12.0, 16.0, Align::left);
  const int intervals = intervals_of(style_.fastest);
  for (int tick = 0; tick <= intervals; ++tick) {
    const double share = static_cast<double>(tick) / intervals;
    const double y = low - share * rows;
    cairo_set_source_rgb(c, 0.13, 0.13, 0.13);
    cairo_set_line_width(c, 1.0);
    cairo_move_to(c, x + bar_width, y);
    cairo_line_to(c, x + bar_width + 5.0, y);
    cairo_stroke(c);
    const std::string number = fmt::format("{}{:.4g}", tick == intervals ? "≥ " : "", share * style_.fastest);
    draw_text(c, number, x + bar_width + 9.0, y + 5.0, 14.0, Align::left);
  }
}

// Names the kinds of side, where there is anything but walls.
void FramePainter::draw_legend(cairo_t* c) const {
  if (!style_.box.has(SideKind::periodic) && !style_.box.has(SideKind::sink)) return;
  double x = left_margin;
  const double y = height_ - 18.0;
  for (const auto& [kind, name] : {std::pair{SideKind::wall, "wall"}, std::pair{SideKind::periodic, "periodic"},
                                   std::pair{SideKind::sink, "sink"}}) {
    if (!style_.box.has(kind)) continue;
    set_stroke(c, kind);
    cairo_move_to(c, x, y - 5.0);
    cairo_line_to(c, x + 34.0, y - 5.0);
    cairo_stroke(c);
    cairo_set_dash(c, nullptr, 0, 0.0);
    draw_text(c, name, x + 42.0, y, 14.0, Align::left);
    x += 134.0;
  }
}

void FramePainter::draw_disks(const Disks& disks) {
  const Domain& box = style_.box;
  const PixelArea area{reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(image_.get())),
                       cairo_image_surface_get_stride(image_.get()) / 4,
                       static_cast<int>(left_),
                       static_cast<int>(std::lround(bottom_ - box.height * scale_)),
                       static_cast<int>(std::lround(left_ + box.width * scale_)),
                       static_cast<int>(bottom_)};
  const double smallest = disks.size() <= few_disks ? smallest_of_few : 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double speed = std::sqrt(disks.vx[i] * disks.vx[i] + disks.vy[i] * disks.vy[i]);
    const Colour colour = viridis(speed / style_.fastest);
    const double r = disks.radius_of(i);
    const double pixels = std::max(r * scale_, smallest);
    // A disk across a periodic side is seen on the other one too.
    const double across = !box.periodic_x()            ? 0.0
                          : disks.x[i] < r             ? box.width
                          : disks.x[i] > box.width - r ? -box.width
                                                       : 0.0;
    const double along = !box.periodic_y()             ? 0.0
                         : disks.y[i] < r              ? box.height
                         : disks.y[i] > box.height - r ? -box.height
                                                       : 0.0;
    const auto draw = [&](double x, double y) {
      fill_disk(area, left_ + x * scale_, bottom_ - y * scale_, pixels, colour);
    };
    draw(disks.x[i], disks.y[i]);
    if (across != 0.0) draw(disks.x[i] + across, disks.y[i]);
    if (along != 0.0) draw(disks.x[i], disks.y[i] + along);
    if (across != 0.0 && along != 0.0) draw(disks.x[i] + across, disks.y[i] + along);
  }
}

void FramePainter::paint(const Disks& disks, double time) {
  cairo_surface_flush(image_.get());
  std::memcpy(cairo_image_surface_get_data(image_.get()), cairo_image_surface_get_data(background_.get()), bytes());
  draw_disks(disks);
  cairo_surface_mark_dirty(image_.get());
  const Context context = context_of(image_);
  for (const Side side : all_sides) draw_side(context.get(), side);
  const std::string count = disks.size() == 1 ? "1 disk" : fmt::format("{} disks", disks.size());
  draw_text(context.get(), time_stamp(time, style_.time_decimals), left_margin, 62.0, 18.0, Align::left);
  draw_text(context.get(), count, width_ - right_margin, 62.0, 18.0, Align::right);
  cairo_surface_flush(image_.get());
}

void FramePainter::write_png(const std::string& path) const {
  const cairo_status_t status = cairo_surface_write_to_png(image_.get(), path.c_str());
  if (status != CAIRO_STATUS_SUCCESS) {
    throw RunError(fmt::format("cannot write {}: {}", path, cairo_status_to_string(status)));
  }
}

}  // namespace carom
