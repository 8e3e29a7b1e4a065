// How far disks may move from their listed positions, and how long that takes.
#pragma once

#include <cmath>

#include "core/base/types.hpp"
#include "core/physics/exact_path.hpp"

namespace carom {

// How far a disk may move from its listed position before it is relisted.
struct RelistDistance {
  double length = 0.0;
  double stay2 = never;  // the length squared, a little less
  double lead2 = 0.0;    // squared: how far ahead of where it is a disk is listed at most
};

// For how long a point that is now at d and moves at velocity v stays within a distance of the origin; 0 if it is not
// within it now. distance2: the distance squared.
inline double time_within(double distance2, Vec2 d, Vec2 v) {
  const double c = distance2 - (d.x * d.x + d.y * d.y);
  if (!(c > 0.0)) return 0.0;
  const double a = v.x * v.x + v.y * v.y;
  if (a == 0.0) return never;
  const double b = d.x * v.x + d.y * v.y;
  const double root = std::sqrt(b * b + a * c);
  return b > 0.0 ? c / (b + root) : (root - b) / a;
}

}  // namespace carom
