// How long disks stay near their listed positions. For a sheared box: flow_lists.cpp.
#include <algorithm>
#include <cmath>

#include "core/physics/boundary.hpp"
#include "parallel/exact/neighbour_lists.hpp"

namespace carom {

double NeighbourLists::earliest_relist_time(std::uint32_t i, const PathSegment& path, double from, double until,
                                            const Gravity& gravity, const RelistDistance& relist) const {
  if (mode_ == EngineMode::all_pairs) return never;
  if (flow_.acts) return earliest_relist_in_flow(i, path, from, until);
  const PathSegment p = carried_to(path, from, gravity);
  const double g = gravity.size;
  const Vec2 position = listed_position(i);
  const auto [dx, dy] = nearest_image_at_rest({p.x - position.x, p.y - position.y}, box_);
  double room = relist.length * (1.0 - 1e-9);
  double ahead = never;
  if (g > 0.0) {
    // The straight path, less the most by which gravity can bend it in that time.
    ahead = std::max(std::sqrt(2.0 * bend_share * relist.length / g), until - from);
    room -= 0.5 * g * ahead * ahead;
    if (!(room > 0.0)) return from;
  }
  return from + std::min(time_within(room * room, {dx, dy}, {p.vx, p.vy}), ahead);
}

// A straight path whose ends are in a circle stays in it; gravity bends it by at most g t^2 / 8, so the ends have to be
// further inside by that.
bool NeighbourLists::stays_listed_falling(std::uint32_t i, const PathSegment& path, double from, double until,
                                          const Gravity& g, const RelistDistance& relist) const {
  if (mode_ == EngineMode::all_pairs) return true;
  const double room = relist.length * (1.0 - 1e-9) - 0.125 * g.size * (until - from) * (until - from);
  const auto at = [&](double t) {
    const double s = t - path.start;
    return Vec2{path.x + (path.vx - 0.5 * g.left * s) * s, path.y + (path.vy - 0.5 * g.down * s) * s};
  };
  return begins_and_ends_within(room, listed_position(i), at(from), at(until));
}

// Both ends must be in the same image of the circle, the nearest one to the first end: the path may go round the box,
// to another image.
bool NeighbourLists::begins_and_ends_within(double room, Vec2 centre, Vec2 first, Vec2 last) const {
  const Vec2 d = listed_box_.nearest_image_of({first.x - centre.x, first.y - centre.y});
  const Vec2 end{d.x + (last.x - first.x), d.y + (last.y - first.y)};
  return room > 0.0 && d.x * d.x + d.y * d.y < room * room && end.x * end.x + end.y * end.y < room * room;
}

// Listed disks are within their contact distance and 4 skins of each other, and at the window's start within two
// flights more; if that is less than half a period, the nearest image is the right one.
double NeighbourLists::safe_speed2(double length, double g) const {
  double period = HUGE_VAL;
  if (box_.periodic_x()) period = std::min(period, box_.width);
  if (box_.periodic_y()) period = std::min(period, box_.height);
  if (period == HUGE_VAL) return HUGE_VAL;
  if (mode_ == EngineMode::all_pairs) return -1.0;
  const double listed = flow_.stretch * (2.0 * flow_.stretch * largest_radius_ + 4.0 * skin_ + search_margin_);
  const double flight = 0.5 * (0.49 * period - listed) - g * length * length;
  return flight > 0.0 ? (flight / length) * (flight / length) : -1.0;
}

}  // namespace carom
