// Sources that a test writes down itself.
#pragma once

#include "core/scene/scene.hpp"

namespace carom::test {

// Of disks of mass 1 and this radius; rate: disks per unit time. It has neither a side nor a region yet.
inline Source source_of(double rate, double radius) {
  Source source;
  source.rate = rate;
  source.radius.value = radius;
  source.mass.value = 1.0;
  return source;
}

// The same in a rectangle.
inline Source source_in(Vec2 low, Vec2 high, double rate, double radius) {
  Source source = source_of(rate, radius);
  source.region_low = low;
  source.region_high = high;
  return source;
}

}  // namespace carom::test
