// Where a thread's part of the box ends.
#pragma once

#include <cmath>

#include "core/base/types.hpp"
#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/known_band.hpp"

namespace carom {

// A part is what lies between two coordinates, x or y, when the lists are built. Its own disks are those that lie there
// then, wherever they go until they are built again.
struct PartEnds {
  bool along_x = false;  // x tells, not y
  KnownBand between;
  // As between: where the parts next to this one end, and others begin.
  double next_below = -HUGE_VAL, next_above = HUGE_VAL;

  double coordinate(Vec2 at) const { return along_x ? at.x : at.y; }

  // The disk is listed here, and stays within `distance` of it. Marks it where it may come beyond an end. False if the
  // part behind that end does not have it, or if it may come to a third part, whose disks neither of the two has.
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
