// Which contacts a disk has at the end of a step, and how long ago each began.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/disks/disk_view.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/place_slack.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/physics/moving_side.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/physics/step_rules.hpp"

namespace carom {

// Position and velocity of disk j relative to disk i, nearest image. ago: how long before the time of the box the
// positions are meant; matters in a sheared box only. Precondition, here and in resolve.hpp wherever a View is taken:
// View::is_sheared if the box is sheared.
template <class View>
Relative relative(const View& d, std::uint32_t i, std::uint32_t j, const Domain& box,
                  [[maybe_unused]] double ago = 0.0) {
  const Relative raw{d.x[j] - d.x[i], d.y[j] - d.y[i], d.vx[j] - d.vx[i], d.vy[j] - d.vy[i]};
  if constexpr (View::is_sheared) {
    return to_row(raw, rows_to_nearest(raw.dy, box), box.shear.offset - ago * box.shear.jump, box);
  } else {
    const Vec2 apart = nearest_image_at_rest({raw.dx, raw.dy}, box);
    return {apart.x, apart.y, raw.dvx, raw.dvy};
  }
}

// Squared distance of the centres of disks i and j, nearest image; length^2.
template <class View>
double distance2_of(const View& d, std::uint32_t i, std::uint32_t j, const Domain& box) {
  const Vec2 apart{d.x[j] - d.x[i], d.y[j] - d.y[i]};
  if constexpr (View::is_sheared) {
    return nearest_distance2(apart, box);
  } else {
    const Vec2 nearest = nearest_image_at_rest(apart, box);
    return nearest.x * nearest.x + nearest.y * nearest.y;
  }
}

// The contact event of a pair found touching at the end of a step: how long ago it began, at most the step.
template <class View>
ContactEvent pair_event(const View& d, const StepRules& rules, std::uint32_t i, std::uint32_t j) {
  const Relative r = relative(d, i, j, rules.box);
  double ago = rules.dt;
  if (r.approach() < 0.0) {
    ago = time_within(std::max(0.0, -touching_time(r, d.radius(i) + d.radius(j))), rules.dt);
  }
  return {ago, d.id[i], d.id[j], i, j};
}

// The contact event of a disk that reaches `beyond` >= 0 past a wall.
template <class View>
ContactEvent wall_event(const View& d, const StepRules& rules, std::uint32_t i, Side side, double beyond) {
  const double speed = approach_speed(side, d.vx[i], d.vy[i], rules.box.place(side));
  double ago = rules.dt;
  if (speed > 0.0) ago = time_within(time_since_wall(side, beyond, speed, rules.gravity), rules.dt);
  return {ago, d.id[i], wall_partner(side), i, 0};
}

// The contact event of disk i and obstacle k.
template <class View>
ContactEvent obstacle_event(const View& d, const StepRules& rules, std::uint32_t i, std::uint32_t k,
                            const ObstacleGap& gap) {
  double ago = rules.dt;
  if (speed_towards(gap, d.vx[i], d.vy[i]) > 0.0 && gap.beyond >= 0.0) {
    const Obstacle& o = (*rules.box.obstacles)[k];
    ago = time_within(
        time_since_obstacle(o, gap, d.radius(i), d.vx[i] - gap.velocity.x, d.vy[i] - gap.velocity.y, rules.gravity),
        rules.dt);
  }
  return {ago, d.id[i], obstacle_partner(k), i, 0};
}

// The gap between disk i and the obstacle of a contact.
template <class View>
ObstacleGap gap_to(const View& d, const Domain& box, std::uint32_t i, DiskId partner) {
  return gap_to((*box.obstacles)[obstacle_of(partner)], d.x[i], d.y[i], d.radius(i), box);
}

// How far disk i reaches beyond the wall, or the obstacle, of a contact; length.
template <class View>
double reach_beyond_wall(const View& d, const Domain& box, std::uint32_t i, DiskId partner) {
  if (is_obstacle(partner)) return gap_to(d, box, i, partner).beyond;
  return reach_beyond_wall(wall_side(partner), d.x[i], d.y[i], d.radius(i), box);
}

// The number of the sink that a contact's partner is; no_sink if it takes no disks away. partner: a wall's or an
// obstacle's.
inline SinkNumber sink_of(const Domain& box, DiskId partner) {
  if (is_obstacle(partner)) {
    const Obstacle& o = (*box.obstacles)[obstacle_of(partner)];
    return o.kind == ObstacleKind::sink ? sink_number(o) : no_sink;
  }
  const Side side = wall_side(partner);
  return box.side(side) == SideKind::sink ? sink_number(side) : no_sink;
}

// An inner sink that lies along a wall, or before it, is an opening in that wall. This is the depth by which disk i
// lies in an inner sink, plus rounding (length; negative if it touches none); the disk collides only with walls in
// which it lies deeper.
template <class View>
double depth_of_opening(const View& d, const Domain& box, std::uint32_t i) {
  double depth = -1.0;
  if (box.obstacles == nullptr || !box.obstacles->has_sinks()) return depth;
  for_each_obstacle_touched(box, d.x[i], d.y[i], d.radius(i), [&](std::uint32_t k, const ObstacleGap& gap) {
    if ((*box.obstacles)[k].kind == ObstacleKind::sink) depth = std::max(depth, gap.beyond);
  });
  if (depth < 0.0) return depth;
  return depth + place_slack(box, d.radius(i));
}

// Calls found(event) for each wall side and solid obstacle that disk i touches or reaches beyond; not where an inner
// sink is an opening in it, and only once where inner walls join.
template <class View, class Found>
void for_each_wall_contact(const View& d, const StepRules& rules, std::uint32_t i, Found&& found) {
  const double open = depth_of_opening(d, rules.box, i);
  for (Side side : all_sides) {
    if (rules.box.side(side) != SideKind::wall) continue;
    const double beyond = reach_beyond_wall(side, d.x[i], d.y[i], d.radius(i), rules.box);
    if (beyond >= 0.0 && beyond > open) found(wall_event(d, rules, i, side, beyond));
  }
  if (rules.box.obstacles == nullptr) return;
  for_each_solid_touched(rules.box, d.x[i], d.y[i], d.radius(i), [&](std::uint32_t k, const ObstacleGap& gap) {
    if (gap.beyond <= open || is_hidden(rules.box, k, gap, d.x[i], d.y[i], d.radius(i))) return;
    found(obstacle_event(d, rules, i, k, gap));
  });
}

}  // namespace carom
