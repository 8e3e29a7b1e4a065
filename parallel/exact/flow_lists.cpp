// Neighbour lists in a sheared box: places that are carried with the flow, and how long disks stay near them.
#include <algorithm>
#include <cmath>

#include "parallel/exact/neighbour_lists.hpp"

namespace carom {

namespace {

// The strain after which lists are built anew: with a larger one, lists are longer and cost more, since disks are
// carried further.
constexpr double most_strain = 0.25;

}  // namespace

void NeighbourLists::follow_flow(const Domain& box, double start, double length) {
  flow_ = {};
  if (!box.shear.acts()) return;
  flow_.acts = true;
  flow_.rate = box.shear.rate;
  flow_.middle = 0.5 * box.height;
  flow_.tilt = flow_.built_tilt = box.shear.offset / box.height;
  flow_.built_at = start;
  flow_.strain = std::max(most_strain, std::abs(flow_.rate) * length) * (1.0 + 1e-9);
  // The largest singular value of a shear by the largest tilt.
  const double tilt = std::abs(flow_.tilt) + flow_.strain;
  flow_.stretch = (0.5 * tilt + std::sqrt(1.0 + 0.25 * tilt * tilt)) * (1.0 + 1e-9);
}

// The tilt is known only up to multiples of width over height; the one taken is the tilt that has grown since the lists
// were built.
void NeighbourLists::carry_flow(const Domain& box, double start) {
  const double tilt = box.shear.offset / box.height;
  const double period = box.width / box.height;
  const double grown = flow_.built_tilt + flow_.rate * (start - flow_.built_at);
  flow_.tilt = tilt + period * std::round((grown - tilt) / period);
}

// The place at time s of the window, carried into the frame of the lists and wrapped into the box. All images of a disk
// give the same place.
Vec2 NeighbourLists::into_flow(double x, double y, double s) const {
  const auto inside = [](double c, double period) {
    c -= period * std::floor(c / period);
    return c >= 0.0 && c < period ? c : 0.0;
  };
  return {inside(flow_.carried_back(x, y, s), box_.width), inside(y, box_.height)};
}

// A path is bent in the frame that is carried with the flow: x - (tilt + rate s) (y - h / 2 + vy s) has the
// acceleration -2 rate vy.
bool NeighbourLists::stays_listed_in_flow(std::uint32_t i, const PathSegment& path, double from, double until) const {
  if (mode_ == EngineMode::all_pairs) return true;
  const double bend = 0.25 * std::abs(flow_.rate * path.vy) * (until - from) * (until - from);
  const double room = elsewhere_.length * (1.0 - 1e-9) - bend;
  const auto at = [&](double t) {
    const double s = t - path.start;
    const double y = path.y + path.vy * s;
    return Vec2{flow_.carried_back(path.x + path.vx * s, y, t), y};
  };
  return begins_and_ends_within(room, listed_position(i), at(from), at(until));
}

double NeighbourLists::earliest_relist_in_flow(std::uint32_t i, const PathSegment& path, double from,
                                               double until) const {
  const PathSegment p = carried_to(path, from, 0.0);
  const double tilt = flow_.tilt_at(from);
  const Vec2 listed = listed_position(i);
  const auto nearest = [](double d, double period) { return d - period * std::round(d / period); };
  const Vec2 off{nearest(flow_.carried_back(p.x, p.y, from) - listed.x, box_.width),
                 nearest(p.y - listed.y, box_.height)};
  const Vec2 speed{p.vx - flow_.rate * (p.y - flow_.middle) - tilt * p.vy, p.vy};
  double room = elsewhere_.length * (1.0 - 1e-9);
  double ahead = never;
  // The straight path, less the most by which the flow can bend it in that time.
  const double half_bend = std::abs(flow_.rate * p.vy);
  if (half_bend > 0.0) {
    ahead = std::max(std::sqrt(bend_share * elsewhere_.length / half_bend), until - from);
    room -= half_bend * ahead * ahead;
    if (!(room > 0.0)) return from;
  }
  return from + std::min(time_within(room * room, off, speed), ahead);
}

}  // namespace carom
