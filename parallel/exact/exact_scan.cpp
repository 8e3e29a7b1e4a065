#include "parallel/exact/exact_scan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace carom {

NextEvent ExactScan::earliest(std::uint32_t i, bool& lasting) const {
  const Flight* const flight = field_->flight.data();
  const bool far = flies_far(flight[i].path);
  lasting = far;  // rare, and not worth telling
  NextEvent best;
  if (far || lists_->sides_near(i) != 0) best = earliest_at_sides(i, flight[i].path, far, lasting);
  if (far) {
    lists_->for_each_neighbour(i, [&](std::uint32_t j) { meet(i, j, best); });
    return best;
  }
  const auto look = [&](const auto& kernel, const auto* offset, std::uint32_t count) {
    const FirstMeetings first = kernel(frame_, flight + i, offset, count);
    lasting = lasting || first.lasting;
    if (!(first.time <= field_->horizon) || first.time > best.time) return;
    for (std::uint32_t left = first.bits; left != 0; left &= left - 1U) {
      see(i, i + static_cast<std::uint32_t>(std::int32_t{offset[std::countr_zero(left)]}), first.time, best);
    }
  };
  static_assert(ExactLists::chunk <= most_neighbours);
  lists_->see_offsets(
      i, [&](const std::int16_t* offset, std::uint32_t count) { look(kernels_.near, offset, count); },
      [&](const std::int32_t* offset, std::uint32_t count) { look(kernels_.far, offset, count); });
  return best;
}

// With images beyond the nearest one.
void ExactScan::meet(std::uint32_t i, std::uint32_t j, NextEvent& best) const {
  const Flight& own = field_->flight[i];
  const Flight& other = field_->flight[j];
  const ExactRules& rules = field_->rules;
  const bool in_order = own.id < other.id;
  const double reach = own.radius + other.radius;
  const double t = meeting_time(in_order ? own.path : other.path, in_order ? other.path : own.path, reach, rules.box,
                                rules.gravity, field_->horizon);
  if (t < never) see(i, j, t, best);
}

// `best` becomes this meeting if it comes first.
void ExactScan::see(std::uint32_t i, std::uint32_t j, double time, NextEvent& best) const {
  const DiskId own = field_->flight[i].id;
  const DiskId other = field_->flight[j].id;
  const NextEvent e{time, std::min(own, other), std::max(own, other), j};
  if (e.before(best)) best = e;
}

MeetingFrame ExactScan::frame_of(const ExactField& field) {
  const ExactRules& rules = field.rules;
  MeetingFrame f{rules.gravity, 0.0, 0.0, HUGE_VAL, HUGE_VAL};
  const double reach = 2.0 * field.largest_radius;
  f.close2 = 4.0 * (reach * reach) * (field.close * field.close);
  f.slow2 = (reach * reach) * (field.slow * field.slow);
  if (rules.box.periodic_x()) {
    f.width = rules.box.width;
    f.half_width = 0.5 * f.width;
  }
  if (rules.box.periodic_y()) {
    f.height = rules.box.height;
    f.half_height = 0.5 * f.height;
  }
  return f;
}

NextEvent ExactScan::earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far, bool& lasting) const {
  const Flight& own = field_->flight[i];
  const Domain& box = field_->rules.box;
  const double g = field_->rules.gravity;
  NextEvent best;
  const auto look = [&](Side side) {
    const NextEvent e{side_time(path, side, own.radius, box, g, field_->horizon), own.id, wall_partner(side), i};
    if (e.time < never && e.before(best)) best = e;
  };
  const unsigned near = lists_->sides_near(i);
  if (near != 0) {
    for (const Side side : all_sides) {
      if ((near >> static_cast<unsigned>(side) & 1U) == 0) continue;
      look(side);
      const bool close = std::abs(reach_beyond(side, path.x, path.y, own.radius, box)) <= field_->close;
      lasting = lasting || (close && std::abs(outward_speed(side, path.vx, path.vy)) <= field_->slow);
    }
  }
  if (!far) return best;
  // Crossing events can only happen to a disk that flies far within the window.
  const double span = (field_->horizon - path.start) * (1.0 + 1e-9);
  if (box.periodic_x() && std::abs(path.vx) * span >= longest_flight * box.width) {
    look(path.vx > 0.0 ? Side::right : Side::left);
  }
  if (box.periodic_y() && (std::abs(path.vy) + g * span) * span >= longest_flight * box.height) {
    look(path.vy > 0.0 ? Side::top : Side::bottom);
  }
  return best;
}

}  // namespace carom
