// Where a part of the box ends (HaloPart).
#pragma once

#include <cmath>

#include "core/base/types.hpp"
#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/known_band.hpp"

namespace carom {

// A part lies between two coordinates, x or y. Its own disks are those that lie there when the lists are built,
// wherever they go until the next time.
struct PartEnds {
  bool along_x = false;  // x tells, not y
  KnownBand between;
  // As in `between`: where the parts next to this one end, and third parts begin.
  double next_below = -HUGE_VAL, next_above = HUGE_VAL;

  double coordinate(Vec2 at) const { return along_x ? at.x : at.y; }

  // The disk has been listed at this place and stays within `distance` of it. Marks it as one that crosses where it may
  // come beyond an end. False if the part there does not have it as a ghost, or if it may come to a third part: then
  // the window would be void.
  bool note_listing(Vec2 at, double distance, DiskRecord& disk) const {
    if (disk.progress.has(DiskProgress::ghost)) return true;
    const double reach = (distance + disk.radius) * (1.0 + 1e-9);
    const double d = between.from_centre(coordinate(at));
    const bool below = d - reach < between.below;
    const bool above = d + reach > between.above;
    if (!below && !above) [[likely]]
      return true;
    disk.progress.set(DiskProgress::crosses);
    if (d - reach < next_below || d + reach > next_above) return false;
    return (!below || disk.progress.has(DiskProgress::known_below)) &&
           (!above || disk.progress.has(DiskProgress::known_above));
  }
};

}  // namespace carom
