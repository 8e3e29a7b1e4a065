#include "core/start/start_region.hpp"

#include <algorithm>
#include <numbers>

namespace carom {

namespace {

// Share of a region's size by which rounding must not rule out what is allowed.
constexpr double region_margin = 1e-9;

bool meets_along(double low, double high, double region_low, double region_high, double radius) {
  const double slack = region_margin * (region_high - region_low);
  return high >= region_low + radius - slack && low <= region_high - radius + slack;
}

}  // namespace

bool may_hold_centre(const StartRegion& region, const Domain& box, Vec2 low, Vec2 high, double radius) {
  if (!spans_x(region, box) && !meets_along(low.x, high.x, region.low.x, region.high.x, radius)) return false;
  if (!spans_y(region, box) && !meets_along(low.y, high.y, region.low.y, region.high.y, radius)) return false;
  if (!region.circle) return true;
  const double x = std::clamp(region.centre.x, low.x, high.x) - region.centre.x;
  const double y = std::clamp(region.centre.y, low.y, high.y) - region.centre.y;
  const double reach = std::max(0.0, region.radius - radius) + region_margin * region.radius;
  return x * x + y * y <= reach * reach;
}

double area_of(const StartRegion& region) {
  if (region.circle) return std::numbers::pi * region.radius * region.radius;
  return (region.high.x - region.low.x) * (region.high.y - region.low.y);
}

}  // namespace carom
