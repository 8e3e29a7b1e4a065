// The part of the box in which a group starts (StartRegion), and the places for centres in it.
#pragma once

#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Does the region reach from one periodic side to the other, so that it has no edge there?
inline bool spans_x(const StartRegion& region, const Domain& box) {
  return !region.circle && box.periodic_x() && region.low.x == 0.0 && region.high.x == box.width;
}
inline bool spans_y(const StartRegion& region, const Domain& box) {
  return !region.circle && box.periodic_y() && region.low.y == 0.0 && region.high.y == box.height;
}

// May the centre of a disk of this radius that is entirely within the region be in the rectangle [low, high]? True if
// rounding leaves a doubt.
bool may_hold_centre(const StartRegion& region, const Domain& box, Vec2 low, Vec2 high, double radius);

// The region's area; length^2.
double area_of(const StartRegion& region);

}  // namespace carom
