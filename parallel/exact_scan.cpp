#include "parallel/exact_scan.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

// The exact formula; `found.best` becomes this meeting if it comes first.
void ExactScan::meet(std::uint32_t i, const PathSegment& path, std::uint32_t j, const PathSegment& other,
                     double soonest, Earliest& found) const {
  const Flight& own = field_.flight[i];
  const DiskId id = field_.flight[j].id;
  const ExactRules& rules = field_.rules;
  const bool in_order = own.id < id;
  const double reach = own.radius + field_.flight[j].radius;
  const PathSegment& first = in_order ? path : other;
  const PathSegment& second = in_order ? other : path;
  const double t = meeting_time(first, second, reach, rules.box, rules.gravity, field_.horizon);
  const NextEvent e{t, in_order ? own.id : id, in_order ? id : own.id, j, 0};
  if (t != never && e.before(found.best)) {
    found.second = std::min(found.second, found.best.time);
    found.best = e;
  } else {
    // Which they miss, perhaps, by a rounding error only.
    found.second = std::min(found.second, soonest);
  }
}

// One whose sketch cannot be relied on: how near it is, and how fast they approach, tell nearly as much.
void ExactScan::meet_outside(std::uint32_t i, const PathSegment& path, double from, std::uint32_t j,
                             const PathSegment& other, Earliest& found) const {
  const ExactRules& rules = field_.rules;
  const Relative r = relative(carried_to(path, from, rules.gravity), carried_to(other, from, rules.gravity), rules.box);
  const double a = r.dvx * r.dvx + r.dvy * r.dvy;
  const double b = r.approach();
  if (b > 0.0 && b * b > field_.slack * field_.slack * a) return;
  const double gap = std::sqrt(r.distance2()) - (field_.flight[i].radius + field_.flight[j].radius + field_.slack);
  const double soonest = gap > 0.0 ? from + gap / std::sqrt(a) * (1.0 - 1e-9) : from;
  if (soonest > std::min(found.best.time, field_.horizon)) {
    found.second = std::min(found.second, soonest);
  } else {
    meet(i, path, j, other, soonest, found);
  }
}

double ExactScan::clear_meeting(std::uint32_t i, std::uint32_t j) const {
  const bool in_order = field_.flight[i].id < field_.flight[j].id;
  const Flight& first = field_.flight[in_order ? i : j];
  const Flight& second = field_.flight[in_order ? j : i];
  const auto meeting = [&](double reach) {
    return meeting_time(first.path, second.path, reach, field_.rules.box, field_.rules.gravity, field_.horizon);
  };
  const double t = meeting(first.radius + second.radius);
  const double shifted = meeting(first.radius + second.radius + field_.slack);
  return t - shifted < 0.25 * clear_share * field_.length ? t : never;
}

SketchFrame ExactScan::common_frame(const ExactField& field) {
  const Domain& box = field.rules.box;
  const Disks& d = *field.disks;
  const double per_length = field.units.per_length;
  SketchFrame f;
  f.half_width = f.half_height = HUGE_VALF;
  if (box.periodic_x()) {
    f.width = static_cast<float>(box.width * per_length);
    f.half_width = 0.5F * f.width;
  }
  if (box.periodic_y()) {
    f.height = static_cast<float>(box.height * per_length);
    f.half_height = 0.5F * f.height;
  }
  f.radius = d.radius.empty() ? nullptr : d.radius.data();
  f.per_length = static_cast<float>(per_length);
  return f;
}

SketchFrame ExactScan::frame(std::uint32_t i, const PathSegment& path, double from) const {
  const double g = field_.rules.gravity;
  const SketchUnits& units = field_.units;
  const double s = from - path.start;
  const double vy = path.vy - g * s;
  SketchFrame f = common_;
  f.from = static_cast<float>(from * units.per_time);
  f.x = static_cast<float>((path.x + path.vx * s) * units.per_length);
  // Of the falling frame, where neighbours' places are told too.
  f.y = static_cast<float>((path.y + 0.5 * (path.vy + vy) * s + 0.5 * g * from * from) * units.per_length);
  f.vx = static_cast<float>(path.vx * units.per_speed);
  f.vy = static_cast<float>((vy + g * from) * units.per_speed);
  const double own = field_.flight[i].radius + blur_;
  const double reach = f.radius == nullptr ? own + field_.disks->common_radius : own;
  f.reach = static_cast<float>(reach * units.per_length * (1.0 + 1e-6));
  return f;
}

NextEvent ExactScan::earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far) const {
  const Flight& own = field_.flight[i];
  const Domain& box = field_.rules.box;
  const double g = field_.rules.gravity;
  NextEvent best;
  const auto look = [&](Side side) {
    const NextEvent e{side_time(path, side, own.radius, box, g, field_.horizon), own.id, wall_partner(side), i, 0};
    if (e.time < never && e.before(best)) best = e;
  };
  const unsigned near = lists_.sides_near(i);
  if (near != 0) {
    for (const Side side : all_sides) {
      if ((near >> static_cast<unsigned>(side) & 1U) != 0) look(side);
    }
  }
  if (!far) return best;
  // Crossing events can only happen to a disk that flies far within the window.
  const double span = (field_.horizon - path.start) * (1.0 + 1e-9);
  if (box.periodic_x() && std::abs(path.vx) * span >= longest_flight * box.width) {
    look(path.vx > 0.0 ? Side::right : Side::left);
  }
  if (box.periodic_y() && (std::abs(path.vy) + g * span) * span >= longest_flight * box.height) {
    look(path.vy > 0.0 ? Side::top : Side::bottom);
  }
  return best;
}

}  // namespace carom
