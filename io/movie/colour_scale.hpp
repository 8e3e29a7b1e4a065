// What the colours of disks stand for, and the range of the scale.
#pragma once

#include <vector>

#include "core/disks/disks_in_pieces.hpp"
#include "core/scene/scene.hpp"
#include "io/movie/colour_map.hpp"

namespace carom {

struct ValueRange {
  double low = 0.0, high = 0.0;
};

// What the disks of a run have, as far as it is known: from its scene and first disks, or from its frames.
struct SeenValues {
  bool any = false;           // else nothing below counts
  double speed_square = 0.0;  // of fast disks
  ValueRange radius, mass;
  DiskId last_id = 0;
  DiskId groups = 0;  // numbers of groups are below

  // A frame: of the speeds, the fastest disk's or 2.5 root mean squares, whichever is less. group: of each disk, or
  // empty; a frame in several pieces has none.
  void add(const DisksInPieces& disks, const std::vector<DiskId>& group);
  void add(const Disks& disks, const std::vector<DiskId>& group) { add(WholeDisks(disks, 0.0), group); }
  void add_radius(double low, double high);
  void add_mass(double low, double high);
};

// The ends of the colour scale: those that the look gives, else round numbers around what was seen. Speeds begin at 0.
ValueRange colour_range(const PictureLook& look, const SeenValues& seen);

// The next of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten; 1 for 0.
double round_up(double value);

// Of a group: colours that stay apart for all common kinds of colour blindness (Okabe and Ito), in turn.
Colour group_colour(DiskId group);

}  // namespace carom
