// One picture of the disks: the box with its four kinds of side, disks coloured by what the look says, a colour bar or
// a list of groups, the time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/obstacle.hpp"
#include "core/scene/scene.hpp"
#include "io/movie/colour_scale.hpp"
#include "io/movie/disk_raster.hpp"

struct _cairo;
struct _cairo_surface;

namespace carom {

// What stays the same over a movie.
struct FrameStyle {
  std::string title;
  Domain box;
  double high = 1.0;                       // upper end of the colour scale; disks beyond it get the same colour
  int time_decimals = 2;                   // digits of the time stamp after the point; negative: scientific
  double low = 0.0;                        // lower end of the colour scale
  PictureLook look{};                      // its range is already in low and high
  std::vector<DiskId> group_ends{};        // see disk_group.hpp; only where groups are coloured
  DiskId groups = 0;                       // that the list of colours names
  std::vector<std::string> group_names{};  // by number, of those that have one
  std::vector<bool> fixed_groups{};        // by number: those of fixed disks, which are grey
  std::vector<Obstacle> obstacles{};
  std::vector<WallMotion> wall_motions{};  // by number of a [[walls]] table; empty where no inner wall moves
};

// What a run's disks will have, as far as its scene and its first disks show. Speeds to expect are those at the start
// (2.5 times the root mean square, or the fastest disk if it is slower), what falling to the floor adds on average,
// also to disks from sources, what equipartition gives the lighter ones, what sources, Brownian motion, thermostats,
// thermal sides and moving walls bring in.
SeenValues foreseen_values(const Scene& scene, const DisksInPieces& first);
inline SeenValues foreseen_values(const Scene& scene, const Disks& first) {
  return foreseen_values(scene, WholeDisks(first, 0.0));
}

// A style for all frames of a run.
FrameStyle frame_style(const Scene& scene, const PictureLook& look, const SeenValues& seen);

// The same without a scene, for a trajectory that has none beside it.
FrameStyle frame_style(const std::string& title, const Domain& box, const PictureLook& look, const SeenValues& seen);

// Where things lie in a picture, in pixels.
struct FrameLayout {
  double unit = 1.0;                // of letters, lines and margins: 1 in a picture of usual size
  double scale = 1.0;               // pixels per length
  double left = 0.0, bottom = 0.0;  // where the box's origin lies
  int width = 0, height = 0;        // of the image; both even, as video codecs want them

  // What the box takes, in pixels: one at least, so that a box however long and narrow shows its disks.
  double across(const Domain& box) const { return std::max(1.0, box.width * scale); }
  double upwards(const Domain& box) const { return std::max(1.0, box.height * scale); }
};
FrameLayout frame_layout(const FrameStyle& style);

class FramePainter {
 public:
  explicit FramePainter(FrameStyle style);
  FramePainter(const FramePainter&) = delete;
  FramePainter& operator=(const FramePainter&) = delete;
  ~FramePainter();

  // Draws a frame; pixels() and write_png() give it until the next call. Disks are drawn in order of ids, so that the
  // rims of two that share a pixel look the same in any storage order. group: of each disk, where the trajectory has
  // it; empty: by the style's group_ends.
  void paint(const DisksInPieces& disks, const std::vector<DiskId>& group = {});
  void paint(const Disks& disks, double time, const std::vector<DiskId>& group = {}) {
    paint(WholeDisks(disks, time), group);
  }

  // Pixels are 32-bit words 0x00rrggbb, row by row from the top.
  int width() const { return layout_.width; }
  int height() const { return layout_.height; }
  const unsigned char* pixels() const;
  std::size_t bytes() const;

  // Throws RunError if the file cannot be written, here and below.
  void write_png(const std::string& path) const;

  // A frame as SVG: circles and letters as curves, whatever the size it is shown at.
  void write_svg(const std::string& path, const Disks& disks, double time, const std::vector<DiskId>& group = {}) const;

 private:
  struct Free {
    void operator()(_cairo* context) const;
    void operator()(_cairo_surface* surface) const;
  };
  using Surface = std::unique_ptr<_cairo_surface, Free>;
  using Context = std::unique_ptr<_cairo, Free>;

  Context context_of(const Surface& surface) const;
  PixelArea box_area(const Surface& surface) const;
  Colour colour_of(const Disks& disks, std::size_t i, const std::vector<DiskId>& group) const;
  // draw(x, y, radius, colour), in pixels, for each disk, and again where it is seen across a periodic side.
  template <class Draw>
  void for_each_disk(const DisksInPieces& disks, const std::vector<DiskId>& group, Draw draw) const;
  template <class Draw>
  void for_each_image(const Disks& disks, std::size_t i, const Domain& box, Draw draw) const;

  FrameStyle style_;
  FrameLayout layout_;
  Surface background_;  // what no frame changes
  Surface image_;
};

}  // namespace carom
