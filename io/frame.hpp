// One picture of the disks: the box with its four kinds of side, disks coloured by speed, a colour bar, the time.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "core/disks.hpp"
#include "core/domain.hpp"
#include "core/scene.hpp"

struct _cairo;
struct _cairo_surface;

namespace carom {

// What stays the same over a movie.
struct FrameStyle {
  std::string title;
  Domain box;
  double fastest = 1.0;   // speed at the upper end of the colour bar; faster disks get the same colour
  int time_decimals = 2;  // digits of the time stamp after the point; negative: scientific
};

// A style for all frames of a run that starts from `first`. The colour scale reaches from 0 to a round number above
// the speeds to expect: those at the start (2.5 times the root mean square, or the fastest disk if it is slower), what
// falling to the floor adds on average, what equipartition gives the lighter ones, what sources and Brownian motion
// bring in.
FrameStyle frame_style(const Scene& scene, const Disks& first);

// The same without a scene, for a trajectory that has none beside it.
FrameStyle frame_style(const std::string& title, const Domain& box, const Disks& first);

class FramePainter {
 public:
  explicit FramePainter(FrameStyle style);
  FramePainter(const FramePainter&) = delete;
  FramePainter& operator=(const FramePainter&) = delete;
  ~FramePainter();

  // Draws a frame; pixels() and write_png() give it until the next call.
  void paint(const Disks& disks, double time);

  // Both even, as video codecs want them. Pixels are 32-bit words 0x00rrggbb, row by row from the top.
  int width() const { return width_; }
  int height() const { return height_; }
  const unsigned char* pixels() const;
  std::size_t bytes() const;

  // Throws RunError if the file cannot be written.
  void write_png(const std::string& path) const;

 private:
  struct Free {
    void operator()(_cairo* context) const;
    void operator()(_cairo_surface* surface) const;
  };
  using Surface = std::unique_ptr<_cairo_surface, Free>;
  using Context = std::unique_ptr<_cairo, Free>;

  Context context_of(const Surface& surface) const;
  void draw_background();
  void draw_side(_cairo* context, Side side) const;
  void draw_colour_bar(_cairo* context) const;
  void draw_legend(_cairo* context) const;
  void draw_disks(const Disks& disks);

  FrameStyle style_;
  double scale_ = 1.0;                // pixels per length
  double left_ = 0.0, bottom_ = 0.0;  // where the box's origin lies, in pixels
  int width_ = 0, height_ = 0;        // of the image, in pixels
  Surface background_;                // what no frame changes
  Surface image_;
};

}  // namespace carom
