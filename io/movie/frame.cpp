#include "io/movie/frame.hpp"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "core/base/check.hpp"
#include "core/scene/disk_group.hpp"
#include "io/movie/disk_raster.hpp"
#include "io/movie/frame_legend.hpp"

// fontconfig keeps its findings until the program ends, and LeakSanitizer would fail every test that draws text.
#ifdef CAROM_ADDRESS_SANITIZER
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

// In units: the longer side of the box has its limit.
constexpr double widest_box = 960.0, highest_box = 800.0;
constexpr double narrowest_picture = 420.0, lowest_picture = 300.0;  // without margins
// The size of a usual picture, in pixels, to which a picture of given size is compared. Letters never become too small
// to be read.
constexpr double usual_width = 1120.0, usual_height = 926.0;
constexpr double smallest_unit = 0.6;

// A few disks far smaller than a pixel would be invisible in a large box; they are drawn with this radius.
constexpr std::size_t few_disks = 5000;
constexpr double smallest_of_few = 1.6;
// Larger than any picture: a trajectory of another program may have any radius, and Cairo would divide the arc of a
// radius of 1e300 into as many pieces as it needs, for ever.
constexpr double largest_drawn = 1e6;

// In order of ids disks may be anywhere in memory: those this far ahead are prefetched while others are drawn.
constexpr std::size_t disks_ahead = 16;

// Inlined, since g++ 12 drops calls of functions that only prefetch.
[[gnu::always_inline]] inline void prefetch_disk(const Disks& d, std::size_t i) {
  for (const double* const column : {d.x.data(), d.y.data(), d.vx.data(), d.vy.data()}) {
    __builtin_prefetch(column + i);
  }
}

// Obstacles as disks, for drawing.
Disks as_disks(const std::vector<Obstacle>& obstacles) {
  Disks disks;
  for (const Obstacle& o : obstacles) {
    if (!o.is_segment()) append(disks, {o.x, o.y, 0.0, 0.0, o.radius, 1.0, o.id});
  }
  return disks;
}

int even(double pixels) {
  return 2 * static_cast<int>(std::ceil(0.5 * pixels));
}

// The layout of a picture whose size follows from the box.
FrameLayout usual_layout(const Domain& box) {
  FrameLayout f;
  f.scale = std::min(widest_box / box.width, highest_box / box.height);
  const double box_width = box.width * f.scale, box_height = box.height * f.scale;
  const double inner_width = std::max(box_width, narrowest_picture);
  const double inner_height = std::max(box_height, lowest_picture);
  f.width = even(left_margin + inner_width + right_margin);
  f.height = even(top_margin + inner_height + bottom_margin);
  f.left = std::round(left_margin + 0.5 * (inner_width - box_width));
  f.bottom = std::round(top_margin + 0.5 * (inner_height + box_height));
  return f;
}

// The layout of a picture of a given size, with the largest box that fits.
FrameLayout given_layout(const Domain& box, int width, int height) {
  FrameLayout f;
  f.width = width;
  f.height = height;
  f.unit = std::max(smallest_unit, std::min(width / usual_width, height / usual_height));
  const double inner_width = width - (left_margin + right_margin) * f.unit;
  const double inner_height = height - (top_margin + bottom_margin) * f.unit;
  f.scale = std::min(inner_width / box.width, inner_height / box.height);
  f.left = std::round(left_margin * f.unit + 0.5 * (inner_width - box.width * f.scale));
  f.bottom = std::round(top_margin * f.unit + 0.5 * (inner_height + box.height * f.scale));
  return f;
}

}  // namespace

FrameLayout frame_layout(const FrameStyle& style) {
  return style.look.width > 0 ? given_layout(style.box, style.look.width, style.look.height) : usual_layout(style.box);
}

void FramePainter::Free::operator()(_cairo* context) const {
  cairo_destroy(context);
}
void FramePainter::Free::operator()(_cairo_surface* surface) const {
  cairo_surface_destroy(surface);
}

FramePainter::FramePainter(FrameStyle style) : style_(std::move(style)), layout_(frame_layout(style_)) {
  background_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width(), height()));
  image_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width(), height()));
  const Context context = context_of(background_);
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  draw_legends(context.get(), style_, layout_);
  cairo_surface_flush(background_.get());
  const PixelArea area = box_area(background_);
  for_each_disk(
      WholeDisks(as_disks(style_.obstacles), 0.0), {},
      [&area](double x, double y, double radius, const Colour&) { fill_disk(area, x, y, radius, obstacle_colour); });
  cairo_surface_mark_dirty(background_.get());
}

FramePainter::~FramePainter() = default;

FramePainter::Context FramePainter::context_of(const Surface& surface) const {
  return Context(cairo_create(surface.get()));
}

// The pixels within the box.
PixelArea FramePainter::box_area(const Surface& surface) const {
  return {reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(surface.get())),
          cairo_image_surface_get_stride(surface.get()) / 4,
          static_cast<int>(layout_.left),
          static_cast<int>(std::lround(layout_.bottom - layout_.upwards(style_.box))),
          static_cast<int>(std::lround(layout_.left + layout_.across(style_.box))),
          static_cast<int>(layout_.bottom)};
}

const unsigned char* FramePainter::pixels() const {
  return cairo_image_surface_get_data(image_.get());
}

std::size_t FramePainter::bytes() const {
  return static_cast<std::size_t>(cairo_image_surface_get_stride(image_.get())) * static_cast<std::size_t>(height());
}

Colour FramePainter::colour_of(const Disks& disks, std::size_t i, const std::vector<DiskId>& group) const {
  double value = 0.0;
  switch (style_.look.colour) {
    case ColourBy::group:
      return group_colour(group.empty() ? group_of(style_.group_ends, disks.id[i]) : group[i]);
    case ColourBy::speed:
      value = std::sqrt(disks.vx[i] * disks.vx[i] + disks.vy[i] * disks.vy[i]);
      break;
    case ColourBy::radius:
      value = disks.radius_of(i);
      break;
    case ColourBy::mass:
      value = disks.mass_of(i);
      break;
    case ColourBy::id:
      value = static_cast<double>(disks.id[i]);
      break;
  }
  return viridis(style_.high > style_.low ? (value - style_.low) / (style_.high - style_.low) : 0.5);
}

template <class Draw>
void FramePainter::for_each_disk(const DisksInPieces& disks, const std::vector<DiskId>& group, Draw draw) const {
  const Domain box = box_at(style_.box, disks.time());
  const double smallest = disks.size() <= few_disks ? smallest_of_few : 0.0;
  disks.visit([&](const Disks& d) {
    const std::vector<std::size_t> order = by_id(d);
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k + disks_ahead < order.size()) prefetch_disk(d, order[k + disks_ahead]);
      const std::size_t i = order[k];
      const Colour colour = colour_of(d, i, group);
      const double pixels = std::clamp(d.radius_of(i) * layout_.scale, smallest, largest_drawn);
      for_each_image(d, i, box, [&](double x, double y) {
        draw(layout_.left + x * layout_.scale, layout_.bottom - y * layout_.scale, pixels, colour);
      });
    }
  });
}

// A disk across a periodic side is also drawn at the other one. box: at the time of the disks.
template <class Draw>
void FramePainter::for_each_image(const Disks& disks, std::size_t i, const Domain& box, Draw draw) const {
  const double r = disks.radius_of(i);
  const double across = !box.periodic_x()            ? 0.0
                        : disks.x[i] < r             ? box.width
                        : disks.x[i] > box.width - r ? -box.width
                                                     : 0.0;
  const double along = !box.periodic_y()             ? 0.0
                       : disks.y[i] < r              ? box.height
                       : disks.y[i] > box.height - r ? -box.height
                                                     : 0.0;
  draw(disks.x[i], disks.y[i]);
  if (across != 0.0) draw(disks.x[i] + across, disks.y[i]);
  if (along != 0.0 && box.shear.acts()) {
    const double x = wrap(disks.x[i] + (along > 0.0 ? box.shear.offset : -box.shear.offset), box.width);
    for (const double image : {x, x - box.width, x + box.width}) draw(image, disks.y[i] + along);
    return;
  }
  if (along != 0.0) draw(disks.x[i], disks.y[i] + along);
  if (across != 0.0 && along != 0.0) draw(disks.x[i] + across, disks.y[i] + along);
}

void FramePainter::paint(const DisksInPieces& disks, const std::vector<DiskId>& group) {
  cairo_surface_flush(image_.get());
  std::memcpy(cairo_image_surface_get_data(image_.get()), cairo_image_surface_get_data(background_.get()), bytes());
  const PixelArea area = box_area(image_);
  for_each_disk(disks, group, [&area](double x, double y, double radius, const Colour& colour) {
    fill_disk(area, x, y, radius, colour);
  });
  cairo_surface_mark_dirty(image_.get());
  const Context context = context_of(image_);
  const double time = disks.time();
  draw_sides(context.get(), style_, layout_, time);
  draw_inner_walls(context.get(), style_, layout_, time);
  draw_stamps(context.get(), style_, layout_, disks.size(), time);
  cairo_surface_flush(image_.get());
}

namespace {

void check_written(cairo_status_t status, const std::string& path) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw RunError(fmt::format("cannot write {}: {}", path, cairo_status_to_string(status)));
}

}  // namespace

void FramePainter::write_png(const std::string& path) const {
  check_written(cairo_surface_write_to_png(image_.get(), path.c_str()), path);
}

void FramePainter::write_svg(const std::string& path, const Disks& disks, double time,
                             const std::vector<DiskId>& group) const {
  const Surface surface(cairo_svg_surface_create(path.c_str(), width(), height()));
  {
    const Context context = context_of(surface);
    cairo_t* const c = context.get();
    cairo_set_source_rgb(c, 1.0, 1.0, 1.0);
    cairo_paint(c);
    draw_legends(c, style_, layout_);
    cairo_save(c);
    cairo_rectangle(c, layout_.left, layout_.bottom, layout_.across(style_.box), -layout_.upwards(style_.box));
    cairo_clip(c);
    const auto draw = [c](double x, double y, double radius, const Colour& colour) {
      // A rim as in fill_disk, within the disk's radius.
      const double shade = rim_shade(radius);
      cairo_arc(c, x, y, radius, 0.0, 2.0 * std::numbers::pi);
      cairo_set_source_rgb(c, shade * colour.red / 255.0, shade * colour.green / 255.0, shade * colour.blue / 255.0);
      cairo_fill(c);
      if (shade == 1.0) return;
      cairo_arc(c, x, y, radius - rim_width, 0.0, 2.0 * std::numbers::pi);
      cairo_set_source_rgb(c, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
      cairo_fill(c);
    };
    for_each_disk(WholeDisks(as_disks(style_.obstacles), 0.0), {},
                  [&](double x, double y, double radius, const Colour&) { draw(x, y, radius, obstacle_colour); });
    for_each_disk(WholeDisks(disks, time), group, draw);
    cairo_restore(c);
    draw_sides(c, style_, layout_, time);
    draw_inner_walls(c, style_, layout_, time);
    draw_stamps(c, style_, layout_, disks.size(), time);
    check_written(cairo_status(c), path);
  }
  cairo_surface_finish(surface.get());
  check_written(cairo_surface_status(surface.get()), path);
}

}  // namespace carom
