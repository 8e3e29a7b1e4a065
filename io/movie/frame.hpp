// One picture of the disks: the box with its four kinds of side, disks coloured as the look says, a colour bar or a
// list of groups, and the time.
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

// What is the same in all frames of a movie.
struct FrameStyle {
  std::string title;
  Domain box;
  double high = 1.0;                       // upper end of the colour scale; disks beyond it get the same colour
  int time_decimals = 2;                   // digits of the time stamp after the point; negative: scientific
  double low = 0.0;                        // lower end of the colour scale
  PictureLook look{};                      // its range is used for low and high
  std::vector<DiskId> group_ends{};        // see disk_group.hpp; only if groups are coloured
  DiskId groups = 0;                       // number of groups in the list of colours
  std::vector<std::string> group_names{};  // by number, for groups with a name
  std::vector<bool> fixed_groups{};        // by number: is it a group of fixed disks, which are grey?
  std::vector<Obstacle> obstacles{};
  std::vector<WallMotion> wall_motions{};  // by number of a [[walls]] table; empty if no inner wall moves
};

// The values that a run's disks will have, as far as its scene and its first disks show. Expected speeds are those at
// the start (2.5 times the root mean square, or the fastest disk if it is slower), with what falling to the floor adds
// on average, also to disks from sources, what equipartition gives to lighter disks, and what sources, Brownian motion,
// thermostats, thermal sides and moving walls add.
SeenValues foreseen_values(const Scene& scene, const DisksInPieces& first);
inline SeenValues foreseen_values(const Scene& scene, const Disks& first) {
  return foreseen_values(scene, WholeDisks(first, 0.0));
}

// A style for all frames of a run.
FrameStyle frame_style(const Scene& scene, const PictureLook& look, const SeenValues& seen);

// The same without a scene, for a trajectory that has none beside it.
FrameStyle frame_style(const std::string& title, const Domain& box, const PictureLook& look, const SeenValues& seen);

// Positions in a picture, in pixels.
struct FrameLayout {
  double unit = 1.0;                // of letters, lines and margins: 1 in a picture of usual size
  double scale = 1.0;               // pixels per length
  double left = 0.0, bottom = 0.0;  // of the box's origin
  int width = 0, height = 0;        // of the image; both even, as video codecs require

  // The size of the box in pixels: at least one, so that the disks of a very long and narrow box are visible.
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

  // Draws a frame, which pixels() and write_png() use until the next call. Disks are drawn in order of ids, so that the
  // rims of two disks that share a pixel look the same in any storage order. group: of each disk, if the trajectory has
  // it; if empty, groups follow from the style's group_ends.
  void paint(const DisksInPieces& disks, const std::vector<DiskId>& group = {});
  void paint(const Disks& disks, double time, const std::vector<DiskId>& group = {}) {
    paint(WholeDisks(disks, time), group);
  }

  // Pixels are 32-bit words 0x00rrggbb, row by row from the top.
  int width() const { return layout_.width; }
  int height() const { return layout_.height; }
  const unsigned char* pixels() const;
  std::size_t bytes() const;

  // Throws RunError if the file cannot be written, as does write_svg.
  void write_png(const std::string& path) const;

  // Writes a frame as SVG: circles and letters are curves, at any size.
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
  // Calls draw(x, y, radius, colour), in pixels, for each disk, and again for its image across a periodic side.
  template <class Draw>
  void for_each_disk(const DisksInPieces& disks, const std::vector<DiskId>& group, Draw draw) const;
  template <class Draw>
  void for_each_image(const Disks& disks, std::size_t i, const Domain& box, Draw draw) const;

  FrameStyle style_;
  FrameLayout layout_;
  Surface background_;  // what is the same in all frames
  Surface image_;
};

}  // namespace carom
