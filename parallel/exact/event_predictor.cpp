#include "parallel/exact/event_predictor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/physics/event_order.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/physics/obstacle_path.hpp"

namespace carom {

namespace {

// As |dr.dv| and blur are rounded, contacts a little above the limits count as slow, and passes as narrow, too.
constexpr double slow_margin = 1.0 + 1e-9;
constexpr double ambiguous = std::numeric_limits<double>::quiet_NaN();

EventMark mark_of(const WindowState& window, std::uint32_t i, const NextEvent& e) {
  const DiskId own = window.record[i].id;
  const DiskId other = e.partner.is_disk() ? window.record[e.partner.index()].id : e.partner.wall_id();
  return {e.time, std::min(own, other), std::max(own, other)};
}

}  // namespace

// Does disk i's event a happen before its event b, ties in canonical order?
bool EventPredictor::comes_first(std::uint32_t i, const NextEvent& a, const NextEvent& b) const {
  if (a.time != b.time || !(a.time < never)) return a.time < b.time;
  return event_order(mark_of(*window_, i, a), mark_of(*window_, i, b));
}

// The first contact with all neighbours, in the row and in wide rows. FirstContact::neighbour is a storage index here.
FirstContact EventPredictor::first_contact(std::uint32_t i) const {
  const DiskRecord* const own = &window_->record[i];
  FirstContact first;
  const auto see = [&](FirstContact found, const auto* offset) {
    const std::uint32_t place = found.neighbour & ~FirstContact::leaving_bit;
    found.neighbour = i + static_cast<std::uint32_t>(std::int32_t{offset[place]});
    const bool tie = found.time == first.time && found.time < never;
    if (first.is_ambiguous() || found.time >= first.time) {
      if (tie) first.time = ambiguous;
      return;
    }
    first = found;  // ambiguous or earlier
  };
  const ListRow& row = lists_->rows().row(i);
  const bool sheared = sees_moving_images(row);
  const RowKernel in_row = sheared ? kernels_.near_sheared : far_ ? kernels_.near_any_image : kernels_.near;
  const WideRowKernel in_wide_row = sheared ? kernels_.far_sheared : far_ ? kernels_.far_any_image : kernels_.far;
  see(in_row(constants_[0], own, row), row.offset);
  lists_->rows().visit_wide_rows(i, [&](const std::int32_t* offset, std::uint32_t count) {
    see(in_wide_row(constants_[0], own, offset, count), offset);
  });
  return first;
}

NextEvent EventPredictor::earliest(std::uint32_t i) const {
  const ListRow& row = lists_->rows().row(i);
  if (!kernel_tells(row)) return earliest_with_sides(i);
  const FirstContact first = first_in<false>(row, window_->record[i], false);
  if (first.is_ambiguous()) [[unlikely]]
    return earliest_one_by_one(i);
  if (!(first.time <= window_->horizon)) return {};
  return {first.time, partner_in(row, i, first)};
}

NextEvent EventPredictor::earliest_with_sides(std::uint32_t i) const {
  const FirstContact first = first_contact(i);
  if (first.is_ambiguous()) return earliest_one_by_one(i);
  NextEvent best = earliest_at_sides(i);
  if (lists_->is_obstacle_near(i)) see_obstacles(i, std::min(best.time, first.time), best);
  if (!(first.time <= window_->horizon)) return best;
  const NextEvent contact{first.time, Partner::disk(first.neighbour), best.lasting};
  return comes_first(i, contact, best) ? contact : best;
}

// May moving images matter (above and below a sheared box)?
bool EventPredictor::sees_moving_images(const ListRow& row) const {
  return window_->rules.box.shear.acts() && (far_ || (row.sides & ListRow::images_move) != 0);
}

// By the formulas of core, which handle all images and ties.
NextEvent EventPredictor::earliest_one_by_one(std::uint32_t i) const {
  const DiskRecord& own = window_->record[i];
  const ExactRules& rules = window_->rules;
  NextEvent best = earliest_at_sides(i);
  if (lists_->is_obstacle_near(i)) see_obstacles(i, best.time, best);
  // Contacts with images beyond the nearest one are not examined.
  bool lasting = best.lasting || far_;
  lists_->for_each_neighbour(i, [&](std::uint32_t j) {
    const DiskRecord& other = window_->record[j];
    const bool in_order = own.id < other.id;
    const PathSegment& a = in_order ? own.path : other.path;
    const PathSegment& b = in_order ? other.path : own.path;
    const double contact_distance = own.radius + other.radius;
    const double both = std::max(a.start, b.start);
    const PathSegment p = carried_to(a, both, rules.gravity), q = carried_to(b, both, rules.gravity);
    const Relative r = rules.box.shear.acts() ? relative_in_shear(p, q, rules.box) : relative(p, q, rules.box);
    const double gap = r.distance2() - contact_distance * contact_distance;
    lasting = lasting || (gap * gap <= window_->close2() && r.approach() * r.approach() <= window_->slow2()) ||
              window_->may_graze(r, contact_distance, window_->horizon - both);
    const double time = collision_time(a, b, contact_distance, rules.box, rules.gravity, window_->horizon);
    const NextEvent contact{time, Partner::disk(j)};
    if (comes_first(i, contact, best)) best = contact;
  });
  best.lasting = lasting;
  return best;
}

// Replaces `best` by the disk's first contact with an obstacle, if that is earlier, and comes before `end` and the
// horizon. The contact may be a lasting one if the disk is so close to the obstacle, and so slow relative to it, that
// rounding decides whether they touch.
void EventPredictor::see_obstacles(std::uint32_t i, double end, NextEvent& best) const {
  const DiskRecord& own = window_->record[i];
  const PathSegment& path = own.path;
  const Domain& box = window_->rules.box;
  const double close = window_->close;
  bool lasting = best.lasting;
  const auto see_slow = [&](std::uint32_t k, const ObstacleGap& gap) {
    if ((*box.obstacles)[k].kind == ObstacleKind::sink || gap.beyond > 2.0 * close) return;
    lasting = lasting || std::abs(speed_towards(gap, path.vx, path.vy)) <= window_->slow;
  };
  const auto near_start = [&](std::uint32_t k, Vec2 shift) {
    const auto see = [&](const Domain& now) {
      report_if_touched(now, k, shift, path.x, path.y, own.radius + close, see_slow);
    };
    if (lasting) return;
    if (box.inner_walls_move) return see(box_at(box, box.clock.to + path.start));
    see(box);
  };
  const ObstacleContact first = first_obstacle_contact(path, own.radius, box, window_->rules.gravity,
                                                       std::min(end, window_->horizon), close, near_start);
  const NextEvent contact{first.time, Partner::obstacle(first.obstacle), false};
  if (comes_first(i, contact, best)) best = contact;
  best.lasting = lasting;
}

PredictionConstants EventPredictor::constants_of(const WindowState& window, const NeighbourLists& lists,
                                                 bool near_border) {
  const ExactRules& rules = window.rules;
  PredictionConstants f;
  f.down = in_all_lanes(rules.gravity.down);
  f.half_down = in_all_lanes(0.5 * rules.gravity.down);
  f.left = in_all_lanes(rules.gravity.left);
  f.half_left = in_all_lanes(0.5 * rules.gravity.left);
  const double contact_distance = window.disks->common_radius + window.disks->common_radius;
  f.contact = in_all_lanes(contact_distance);
  f.contact2 = in_all_lanes(contact_distance * contact_distance);
  f.horizon = in_all_lanes(window.horizon);
  f.slow_approach2 = in_all_lanes(window.slow2() * slow_margin);
  f.blur = in_all_lanes(-window.blur * slow_margin);
  f.blur2 = in_all_lanes(-window.blur * contact_distance * slow_margin);
  f.stay2 = lists.relist_distance(near_border).stay2;
  f.stay = std::sqrt(f.stay2);
  double period = never;  // the shorter one
  if (rules.box.periodic_x()) period = std::min(period, rules.box.width);
  if (rules.box.periodic_y()) period = std::min(period, rules.box.height);
  if (f.stay < never) f.to_other_image = std::max(period - 2.0 * f.stay, 0.0);
  f.to_other_image2 = f.to_other_image * f.to_other_image;
  f.eighth_gravity = 0.125 * rules.gravity.size;
  f.half_gravity = {0.5 * rules.gravity.left, 0.5 * rules.gravity.down};
  f.flow = lists.flow();
  f.listed_unit = {lists.listed_unit().x, lists.listed_unit().y};
  f.offset = in_all_lanes(rules.box.shear.offset);
  f.jump = in_all_lanes(rules.box.shear.jump);
  if (rules.box.periodic_x()) {
    f.period.x = rules.box.width;
    f.periods_per_length.x = 1.0 / rules.box.width;
    f.period_x = f.image_x = in_all_lanes(rules.box.width);
    f.periods_per_x = in_all_lanes(1.0 / rules.box.width);
  }
  if (rules.box.periodic_y()) {
    f.period.y = rules.box.height;
    f.periods_per_length.y = 1.0 / rules.box.height;
    f.period_y = f.image_y = in_all_lanes(rules.box.height);
    f.periods_per_y = in_all_lanes(1.0 / rules.box.height);
  }
  return f;
}

NextEvent EventPredictor::earliest_at_sides(std::uint32_t i) const {
  const DiskRecord& own = window_->record[i];
  const PathSegment& path = own.path;
  const Domain& box = window_->rules.box;
  const Gravity& g = window_->rules.gravity;
  const double span = (window_->horizon - path.start) * (1.0 + 1e-9);
  NextEvent best;
  bool lasting = false;
  const auto see_side = [&](Side side) __attribute__((hot)) {
    const NextEvent e{side_time(path, side, own.radius, box, g, window_->horizon), Partner::wall(side)};
    if (comes_first(i, e, best)) best = e;
  };
  const unsigned near = lists_->rows().row(i).sides;
  for (const Side side : all_sides) {
    if ((near >> static_cast<unsigned>(side) & 1U) == 0) continue;
    see_side(side);
    if (box.moves(side)) {
      const SideApproach a = approach_of(path, side, own.radius, box);
      lasting = lasting || (std::abs(a.gap) <= window_->close && std::abs(a.speed) <= window_->slow) ||
                window_->may_graze_side(a.gap, a.speed, approach_acceleration(side, g, a.place), span);
      continue;
    }
    const double gap = -reach_beyond(side, path.x, path.y, own.radius, box);
    const double speed = outward_speed(side, path.vx, path.vy);
    lasting = lasting || (std::abs(gap) <= window_->close && std::abs(speed) <= window_->slow) ||
              window_->may_graze_side(gap, speed, outward_acceleration(side, g), span);
  }
  best.lasting = lasting;
  if (!far_) return best;
  // Only a disk that moves far within the window has crossing events.
  if (box.periodic_x() && (std::abs(path.vx) + std::abs(g.left) * span) * span >= longest_flight * box.width) {
    see_side(path.vx > 0.0 || (path.vx == 0.0 && g.left < 0.0) ? Side::right : Side::left);
  }
  if (box.periodic_y() && (std::abs(path.vy) + std::abs(g.down) * span) * span >= longest_flight * box.height) {
    see_side(path.vy > 0.0 || (path.vy == 0.0 && g.down < 0.0) ? Side::top : Side::bottom);
  }
  best.lasting = lasting;
  return best;
}

}  // namespace carom
