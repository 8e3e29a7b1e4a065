// The colour scale of disks: values and range.
#pragma once

#include <vector>

#include "core/disks/disks_in_pieces.hpp"
#include "core/scene/scene.hpp"
#include "io/movie/colour_map.hpp"

namespace carom {

struct ValueRange {
  double low = 0.0, high = 0.0;
};

// The ranges of values of the disks of a run, foreseen from its scene and first disks, or collected from its frames.
struct SeenValues {
  bool any = false;           // if false, the other members are meaningless
  double speed_square = 0.0;  // of fast disks
  ValueRange radius, mass;
  DiskId last_id = 0;
  DiskId groups = 0;  // group numbers are below this

  // Adds a frame; its speed is that of the fastest disk, or 2.5 root mean squares if that is less. group: of each disk,
  // or empty; empty for frames in several pieces.
  void add(const DisksInPieces& disks, const std::vector<DiskId>& group);
  void add(const Disks& disks, const std::vector<DiskId>& group) { add(WholeDisks(disks, 0.0), group); }
  void add_radius(double low, double high);
  void add_mass(double low, double high);
};

// The ends of the colour scale: those of the look, or else round numbers around the values seen. Speeds begin at 0.
ValueRange colour_range(const PictureLook& look, const SeenValues& seen);

// The next of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten; 1 for 0.
double round_up(double value);

// The colour of a group: eight colours, in turn, that differ for all common kinds of colour blindness (Okabe and Ito).
Colour group_colour(DiskId group);

}  // namespace carom
