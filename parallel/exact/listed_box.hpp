// The box for listed positions: whole numbers along each side, which wrap round at the end of a period.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/disks/domain.hpp"
#include "parallel/exact/list_row.hpp"

namespace carom {

struct ListedBox {
  ListedBox() = default;
  explicit ListedBox(const Domain& box)
      : unit{box.width / (box.periodic_x() ? 2.0 * two_to_31 : two_to_31),
             box.height / (box.periodic_y() ? 2.0 * two_to_31 : two_to_31)},
        units_per_length{1.0 / unit.x, 1.0 / unit.y},
        period{box.periodic_x() ? box.width : 0.0, box.periodic_y() ? box.height : 0.0},
        periods_per_length{box.periodic_x() ? 1.0 / box.width : 0.0, box.periodic_y() ? 1.0 / box.height : 0.0} {}

  Vec2 unit;  // of a FixedPointPosition; length
  Vec2 units_per_length;
  Vec2 period;              // length; 0: none
  Vec2 periods_per_length;  // 0: none

  Vec2 position_of(FixedPointPosition p) const { return {p.x * unit.x, p.y * unit.y}; }
  // Along a period the whole number wraps by itself; between walls, rounding may have put the place outside.
  [[gnu::hot]] FixedPointPosition fixed_point(double x, double y) const;

  // The nearest image of a difference of places, except for rounding.
  Vec2 nearest_image_of(Vec2 d) const {
    // Rounds to the nearest whole number.
    constexpr double shift = 0x1.8p52;
    d.x -= period.x * ((d.x * periods_per_length.x + shift) - shift);
    d.y -= period.y * ((d.y * periods_per_length.y + shift) - shift);
    return d;
  }

  // Is this place outside the box along a period?
  bool is_outside(double x, double y) const {
    return (x < 0.0 && period.x > 0.0) || (y < 0.0 && period.y > 0.0) || (x >= period.x && period.x > 0.0) ||
           (y >= period.y && period.y > 0.0);
  }
  // A path may leave the box along a period and lead far into it from the other side. Its coordinates are then not
  // those of the place where the disk is listed, so disks there must look for images. Returns, for a disk whose path
  // has come to p, the distance from the border along each side at which it is listed; 0 if p is in the box, or the
  // disk is listed nearer than `near`.
  Vec2 depth_beyond_border(Vec2 p, Vec2 listed, double near) const {
    const auto depth = [near](double c, double at, double length) {
      if ((c >= 0.0 && c < length) || length == 0.0) [[likely]]
        return 0.0;
      const double from_border = std::min(at, length - at);
      return from_border > near ? from_border : 0.0;
    };
    return {depth(p.x, listed.x, period.x), depth(p.y, listed.y, period.y)};
  }

 private:
  static constexpr double two_to_31 = 2147483648.0;
};

// The largest share of a period that a skin may take, so that a disk is within the skin of the nearest image of its
// listed position.
inline constexpr double most_skin = 0.37;
inline constexpr double most_skin_in_flow = 0.15;

// The largest skin that the periods leave room for; length, infinite without periods.
inline double largest_skin(const Domain& box) {
  const double most = box.shear.acts() ? most_skin_in_flow : most_skin;
  double skin = HUGE_VAL;
  if (box.periodic_x()) skin = std::min(skin, most * box.width);
  if (box.periodic_y()) skin = std::min(skin, most * box.height);
  return skin;
}

// Can disks be listed with a skin? They cannot in a box some ten million times as long as its period across: by the
// rounding of its listed position a disk would be outside so small a skin as soon as it is listed.
inline bool can_list_in(const Domain& box) {
  constexpr double fewest_units = 64.0;
  const ListedBox listed(box);
  return largest_skin(box) >= fewest_units * std::max(listed.unit.x, listed.unit.y);
}

}  // namespace carom
