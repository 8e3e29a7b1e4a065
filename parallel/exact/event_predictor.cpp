#include "parallel/exact/event_predictor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/physics/event_order.hpp"

namespace carom {

NextEvent EventPredictor::earliest(std::uint32_t i, bool& lasting) const {
  const DiskRecord* const record = window_->record.data();
  const bool far = moves_far(record[i].path);
  lasting = far;  // far is rare, and its contacts are not examined
  NextEvent best;
  if (far || lists_->sides_near(i) != 0) best = earliest_at_sides(i, record[i].path, far, lasting);
  if (far) {
    lists_->for_each_neighbour(i, [&](std::uint32_t j) { see_collision_with_images(i, j, best); });
    return best;
  }
  const auto see_batch = [&](const auto& kernel, const auto* offset, std::uint32_t count) {
    const FirstContacts first = kernel(constants_, record + i, offset, count);
    lasting = lasting || first.lasting;
    if (!(first.time <= window_->horizon) || first.time > best.time) return;
    for (std::uint32_t left = first.bits; left != 0; left &= left - 1U) {
      see_collision(i, i + static_cast<std::uint32_t>(std::int32_t{offset[std::countr_zero(left)]}), first.time, best);
    }
  };
  static_assert(NeighbourLists::row_capacity <= max_batch);
  lists_->visit_offsets(
      i, [&](const std::int16_t* offset, std::uint32_t count) { see_batch(kernels_.near, offset, count); },
      [&](const std::int32_t* offset, std::uint32_t count) { see_batch(kernels_.far, offset, count); });
  return best;
}

void EventPredictor::see_collision_with_images(std::uint32_t i, std::uint32_t j, NextEvent& best) const {
  const DiskRecord& own = window_->record[i];
  const DiskRecord& other = window_->record[j];
  const ExactRules& rules = window_->rules;
  const bool in_order = own.id < other.id;
  const double contact_distance = own.radius + other.radius;
  const double t = collision_time(in_order ? own.path : other.path, in_order ? other.path : own.path, contact_distance,
                                  rules.box, rules.gravity, window_->horizon);
  if (t < never) see_collision(i, j, t, best);
}

// `best` becomes this collision if it comes first.
void EventPredictor::see_collision(std::uint32_t i, std::uint32_t j, double time, NextEvent& best) const {
  const DiskId own = window_->record[i].id;
  const DiskId other = window_->record[j].id;
  const NextEvent e{time, std::min(own, other), std::max(own, other), Partner::disk(j)};
  if (event_order(e, best)) best = e;
}

PredictionConstants EventPredictor::constants_of(const WindowState& window) {
  const ExactRules& rules = window.rules;
  PredictionConstants f{rules.gravity, 0.0, 0.0, HUGE_VAL, HUGE_VAL};
  const double contact_distance = 2.0 * window.largest_radius;
  f.close2 = 4.0 * (contact_distance * contact_distance) * (window.close * window.close);
  f.slow2 = (contact_distance * contact_distance) * (window.slow * window.slow);
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

NextEvent EventPredictor::earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far, bool& lasting) const {
  const DiskRecord& own = window_->record[i];
  const Domain& box = window_->rules.box;
  const double g = window_->rules.gravity;
  NextEvent best;
  const auto see_side = [&](Side side) {
    const NextEvent e{side_time(path, side, own.radius, box, g, window_->horizon), own.id, wall_partner(side),
                      Partner::wall(side)};
    if (e.time < never && event_order(e, best)) best = e;
  };
  const unsigned near = lists_->sides_near(i);
  if (near != 0) {
    for (const Side side : all_sides) {
      if ((near >> static_cast<unsigned>(side) & 1U) == 0) continue;
      see_side(side);
      const bool close = std::abs(reach_beyond(side, path.x, path.y, own.radius, box)) <= window_->close;
      lasting = lasting || (close && std::abs(outward_speed(side, path.vx, path.vy)) <= window_->slow);
    }
  }
  if (!far) return best;
  // Only a disk that moves far within the window has crossing events.
  const double span = (window_->horizon - path.start) * (1.0 + 1e-9);
  if (box.periodic_x() && std::abs(path.vx) * span >= longest_flight * box.width) {
    see_side(path.vx > 0.0 ? Side::right : Side::left);
  }
  if (box.periodic_y() && (std::abs(path.vy) + g * span) * span >= longest_flight * box.height) {
    see_side(path.vy > 0.0 ? Side::top : Side::bottom);
  }
  return best;
}

}  // namespace carom
