// The collisions of a step: the contacts that it found, resolved in the order in which they began. Overlap that remains
// is pushed apart (push_apart.hpp). The reference calls this on the whole sorted list, the engine on independent parts
// of it. Formula (23) and faults F3, F8, F11: docs/original.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/disks/disk_view.hpp"
#include "core/disks/domain.hpp"
#include "core/physics/advance.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/contact_of_step.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/physics/moving_side.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/physics/restitution.hpp"
#include "core/physics/roughness.hpp"
#include "core/physics/step_rules.hpp"
#include "core/physics/thermal_side.hpp"

namespace carom {

// Adds shear stress and work to the impact of two disks in a sheared box; r: their relative motion before it. rows: row
// of the image of the second disk that collided (image_in_row). momentum: along x, gained by the second disk. Its image
// moves faster by the jump of its row, and so gains jump times momentum more energy than the disk itself; the work of
// the shear is less by that. The stress is the flow of x-momentum along y. The impulse of rough disks is not along the
// line of centres, so the flow of y-momentum along x may differ; it does no work.
inline void record_shear(PairImpact& impact, const Relative& r, int rows, double momentum, bool rough,
                         const Shear& shear) {
  impact.sheared = true;
  impact.shear_virial = rough ? r.dy * momentum : impact.virial * (r.dx * r.dy / r.distance2());
  if (rows != 0) impact.shear_work -= (rows > 0 ? shear.jump : -shear.jump) * momentum;
}

// The same for disks i and j. before: vx of disk j before the collision.
template <class View>
void record_shear_of(const View& d, const StepRules& rules, std::uint32_t i, std::uint32_t j, const Relative& r,
                     double before, PairImpact& impact) {
  if constexpr (View::is_sheared) {
    record_shear(impact, r, rows_to_nearest(d.y[j] - d.y[i], rules.box), d.mass(j) * (d.vx[j] - before),
                 rules.surfaces != nullptr, rules.box.shear);
  }
}

template <class View>
Shares shares_of(const View& d, std::uint32_t i, std::uint32_t j) {
  if constexpr (View::has_mass) {
    return shares(d.mass(i), d.mass(j));
  } else {
    return equal_shares;
  }
}

template <class View>
RoughDisk rough_disk(const View& d, std::uint32_t i) {
  return {d.radius(i), d.vx[i], d.vy[i], d.spin[i]};
}

// Friction between rough disks i and j that have just collided. r: their relative motion before; change: what collide()
// returned.
template <class View>
void rub_pair(const View& d, const StepRules& rules, std::uint32_t i, std::uint32_t j, const Relative& r, Shares share,
              double change) {
  if constexpr (View::may_be_rough) {
    if (View::is_sheared && rules.surfaces == nullptr) return;
    rub_disks(*rules.surfaces, r, share, change, rough_disk(d, i), rough_disk(d, j));
  }
}

// Friction between disk i and a wall or an obstacle that has just changed its velocity by `pressed` along this normal.
template <class View>
void rub_against(const View& d, const StepRules& rules, std::uint32_t i, Vec2 normal, Touching which, double pressed) {
  if constexpr (View::may_be_rough && !View::is_sheared) {
    rub_wall(rules.surfaces->of(which), rules.surfaces->inertia, normal, pressed, rough_disk(d, i));
  }
}

// Moves disk i along its own path; back if t < 0.
template <class View>
void drift_one(const View& d, std::uint32_t i, double t, const Gravity& g) {
  drift<true>(d.x[i], d.y[i], d.vx[i], d.vy[i], t, g);
}

// Moves the pair back to its contact, collides it by (23), and moves it forward again. The state may have changed since
// the contact was found: a pair that no longer overlaps or approaches is left alone (F3, F8). A pair whose contact is
// older than the step (an overlap left from before) collides where it is.
template <class View>
PairImpact resolve_pair(const View& d, const StepRules& rules, std::uint32_t i, std::uint32_t j) {
  Relative r = relative(d, i, j, rules.box);
  const double contact_distance = d.radius(i) + d.radius(j);
  if (!touches(r.distance2(), contact_distance) || !(r.approach() < 0.0)) return {};
  // Disks that just touch and pass along each other may miss by rounding (touching_time is infinite): they collide now.
  const double ago = std::max(0.0, -touching_time(r, contact_distance));
  const bool inside_step = began_within(ago, rules.dt);
  if (inside_step) {
    drift_one(d, i, -ago, rules.gravity);
    drift_one(d, j, -ago, rules.gravity);
    r = relative(d, i, j, rules.box, ago);
  }
  PairImpact impact;
  if (r.distance2() > 0.0 && r.approach() < 0.0) {
    const Shares share = shares_of(d, i, j);
    const double e = pair_restitution(d, rules, i, j, r);
    const double before = d.vx[j];
    const double change = collide(r, share, e, d.vx[i], d.vy[i], d.vx[j], d.vy[j]);
    rub_pair(d, rules, i, j, r, share, change);
    impact = {.virial = reduced_mass(d.mass(i), d.mass(j)) * change, .happened = true, .inaccurate = !inside_step};
    record_shear_of(d, rules, i, j, r, before, impact);
  }
  if (inside_step) {
    drift_one(d, i, ago, rules.gravity);
    drift_one(d, j, ago, rules.gravity);
  }
  return impact;
}

// Puts disk i back to the wall and lets it bounce there. Returns the change of speed.
template <class View>
double bounce_at_wall(const View& d, const StepRules& rules, std::uint32_t i, Side side) {
  const double r = d.radius(i);
  const double speed = outward_speed(side, d.vx[i], d.vy[i]);
  const double beyond = reach_beyond_wall(side, d.x[i], d.y[i], r, rules.box);
  const double away = rules.box.restitution(side) * speed_at_wall(side, beyond, speed, rules.gravity);
  if (side == Side::left || side == Side::right) {
    d.x[i] = touching_coordinate(side, r, rules.box);
    d.vx[i] = side == Side::left ? away : -away;
  } else {
    d.y[i] = touching_coordinate(side, r, rules.box);
    d.vy[i] = side == Side::bottom ? away : -away;
  }
  rub_against(d, rules, i, inward_normal(side), Touching::wall, speed + away);
  return speed + away;
}

// Reflects disk i thermally, without moving it.
template <class View>
WallImpact reflect_at_side(const View& d, const StepRules& rules, std::uint32_t i, Side side) {
  const double before = outward_speed(side, d.vx[i], d.vy[i]);
  const DiskId id = d.id[i];
  const ThermalReflection reflected = reflect_thermally(side, rules.box.temperature(side), d.mass(i),
                                                        {rules.seed, id, rules.thermal_hits[id]++}, d.vx[i], d.vy[i]);
  double heat = reflected.energy;
  if constexpr (View::may_be_rough && !View::is_sheared) {
    if (rules.surfaces->walls.acts()) {
      heat += spin_thermally(rules.surfaces->inertia, rules.box.temperature(side), d.mass(i), d.radius(i),
                             reflected.deviate, d.spin[i]);
    }
  }
  return {.impulse = d.mass(i) * (before - outward_speed(side, d.vx[i], d.vy[i])), .energy = heat, .happened = true};
}

// A disk that reaches `beyond` past a thermal side and moves into it at `speed`. It is reflected once: at its contact,
// or where it is if the contact is older than the step. If it is then still beyond the side (gravity may bring it back
// within the step), it is put at the side.
template <class View>
WallImpact resolve_thermal_wall(const View& d, const StepRules& rules, std::uint32_t i, Side side, double beyond,
                                double speed) {
  const double ago = time_since_wall(side, beyond, speed, rules.gravity);
  const bool inside_step = began_within(ago, rules.dt);
  WallImpact impact;
  if (inside_step) drift_one(d, i, -ago, rules.gravity);
  if (outward_speed(side, d.vx[i], d.vy[i]) > 0.0) impact = reflect_at_side(d, rules, i, side);
  impact.inaccurate = is_met_late(ago, beyond, speed, rules.dt);
  if (inside_step) drift_one(d, i, ago, rules.gravity);
  const double r = d.radius(i);
  if (reach_beyond_wall(side, d.x[i], d.y[i], r, rules.box) >= 0.0) {
    (side == Side::left || side == Side::right ? d.x : d.y)[i] = touching_coordinate(side, r, rules.box);
  }
  return impact;
}

// A disk and a moving side, in the frame of the side: the disk goes back to the contact and bounces there.
template <class View>
WallImpact resolve_moving_wall(const View& d, const StepRules& rules, std::uint32_t i, Side side) {
  const SidePlace& place = rules.box.place(side);
  const double r = d.radius(i);
  const double restitution = rules.box.restitution(side);
  const auto beyond = [&] { return reach_beyond_wall(side, d.x[i], d.y[i], r, rules.box); };
  const auto speed = [&] { return approach_speed(side, d.vx[i], d.vy[i], place); };
  if (!(beyond() >= 0.0) || !(speed() > 0.0)) return {};
  const double ago = time_since_wall(side, beyond(), speed(), rules.gravity);
  const bool late = is_met_late(ago, beyond(), speed(), rules.dt);
  double change = 0.0;
  const auto bounce_off = [&](double approach, double away) {
    const double kick = rebound(side, place, approach, away, d.vx[i], d.vy[i]);
    rub_against(d, rules, i, inward_normal(side), Touching::wall, kick);
    change += kick;
  };
  if (began_within(ago, rules.dt)) {
    drift_one(d, i, -ago, rules.gravity);
    const double approach = speed();
    if (approach > 0.0) bounce_off(approach, restitution * approach);
    drift_one(d, i, ago, rules.gravity);
  }
  if (beyond() >= 0.0 && speed() > 0.0) {
    const double away = restitution * speed_at_wall(side, beyond(), speed(), rules.gravity);
    (side == Side::left || side == Side::right ? d.x : d.y)[i] = touching_coordinate(side, r, rules.box);
    bounce_off(speed(), away);
  }
  const double impulse = d.mass(i) * change;
  return {.impulse = impulse, .energy = impulse * place.speed, .happened = change > 0.0, .inaccurate = late};
}

// A disk and a wall (F11: position and velocity are both corrected). The disk goes back to the contact and bounces
// there. If gravity brings it back to the wall within the step, or its contact is older than the step, it bounces at
// the step's end with the speed that its energy allows. So a disk at rest on the floor stays at rest, and lifting it to
// the wall gives it no energy.
template <class View>
WallImpact resolve_wall(const View& d, const StepRules& rules, std::uint32_t i, Side side) {
  if (rules.box.moves(side)) return resolve_moving_wall(d, rules, i, side);
  const auto beyond = [&] { return reach_beyond(side, d.x[i], d.y[i], d.radius(i), rules.box); };
  const auto speed = [&] { return outward_speed(side, d.vx[i], d.vy[i]); };
  if (!(beyond() >= 0.0) || !(speed() > 0.0)) return {};
  if (rules.box.is_thermal(side)) return resolve_thermal_wall(d, rules, i, side, beyond(), speed());
  const double ago = time_since_wall(side, beyond(), speed(), rules.gravity);
  const bool late = is_met_late(ago, beyond(), speed(), rules.dt);
  double change = 0.0;
  if (began_within(ago, rules.dt)) {
    drift_one(d, i, -ago, rules.gravity);
    const double impact_speed = speed();
    if (impact_speed > 0.0) {
      change = impact_speed * (1.0 + rules.box.restitution(side));
      bounce(side, rules.box.restitution(side), d.vx[i], d.vy[i]);
      rub_against(d, rules, i, inward_normal(side), Touching::wall, change);
    }
    drift_one(d, i, ago, rules.gravity);
  }
  if (beyond() >= 0.0 && speed() > 0.0) change += bounce_at_wall(d, rules, i, side);
  return {.impulse = d.mass(i) * change, .happened = change > 0.0, .inaccurate = late};
}

// Adds `change` to the speed of disk i away from an obstacle.
template <class View>
void kick_away(const View& d, std::uint32_t i, const ObstacleGap& gap, double change) {
  d.vx[i] += change * gap.nx;
  d.vy[i] += change * gap.ny;
}

// As bounce_at_wall: puts disk i back to the obstacle's edge and lets it bounce there. Returns the change of speed.
template <class View>
double bounce_at_obstacle(const View& d, const StepRules& rules, std::uint32_t i, const Obstacle& o) {
  const ObstacleGap gap = gap_to(o, d.x[i], d.y[i], d.radius(i), rules.box);
  const double speed = speed_towards(gap, d.vx[i], d.vy[i]);
  // Lifting the disk by gap.beyond along the normal costs kinetic energy of its motion along the normal.
  const double left = speed * speed - 2.0 * rules.gravity.against(gap.nx, gap.ny) * gap.beyond;
  const double there = std::sqrt(std::max(0.0, left));
  const double away = obstacle_restitution(d, rules, i, o, there) * there;
  d.x[i] += gap.beyond * gap.nx;
  d.y[i] += gap.beyond * gap.ny;
  kick_away(d, i, gap, speed + away);
  rub_against(d, rules, i, {gap.nx, gap.ny}, o.touching(), speed + away);
  return speed + away;
}

// As resolve_wall, for an obstacle at rest.
template <class View>
WallImpact resolve_resting_obstacle(const View& d, const StepRules& rules, std::uint32_t i, const Obstacle& o) {
  const auto gap_now = [&] { return gap_to(o, d.x[i], d.y[i], d.radius(i), rules.box); };
  const auto speed = [&](const ObstacleGap& gap) { return speed_towards(gap, d.vx[i], d.vy[i]); };
  ObstacleGap gap = gap_now();
  if (!(gap.beyond >= 0.0) || !(speed(gap) > 0.0)) return {};
  const double ago = time_since_obstacle(o, gap, d.radius(i), d.vx[i], d.vy[i], rules.gravity);
  const bool late = is_met_late(ago, gap.beyond, speed(gap), rules.dt);
  double change = 0.0;
  if (began_within(ago, rules.dt)) {
    drift_one(d, i, -ago, rules.gravity);
    gap = gap_now();
    const double impact_speed = speed(gap);
    if (impact_speed > 0.0) {
      change = impact_speed * (1.0 + obstacle_restitution(d, rules, i, o, impact_speed));
      kick_away(d, i, gap, change);
      rub_against(d, rules, i, {gap.nx, gap.ny}, o.touching(), change);
    }
    drift_one(d, i, ago, rules.gravity);
    gap = gap_now();
  }
  if (gap.beyond >= 0.0 && speed(gap) > 0.0) change += bounce_at_obstacle(d, rules, i, o);
  return {.impulse = d.mass(i) * change, .happened = change > 0.0, .inaccurate = late};
}

// The same for a moving inner wall, in its frame: there the wall rests where it is at the end of the step.
template <class View>
[[gnu::noinline, gnu::cold]] WallImpact resolve_moving_wall(const View& d, const StepRules& rules, std::uint32_t i,
                                                            const Obstacle& o) {
  PlacedObstacle now = placed(o, rules.box);
  const Vec2 wound = whole_periods({d.x[i] - now.obstacle.x, d.y[i] - now.obstacle.y}, rules.box);
  now.obstacle.x += wound.x;
  now.obstacle.y += wound.y;
  const Vec2 wall = now.place.velocity;
  const Vec2 before{d.vx[i], d.vy[i]};
  d.vx[i] -= wall.x;
  d.vy[i] -= wall.y;
  WallImpact impact = resolve_resting_obstacle(d, rules, i, now.obstacle);
  if (!impact.happened) {
    d.vx[i] = before.x;
    d.vy[i] = before.y;
    return impact;
  }
  d.vx[i] += wall.x;
  d.vy[i] += wall.y;
  record_push(impact, d.mass(i), wall, before, d.vx[i], d.vy[i]);
  return impact;
}

template <class View>
WallImpact resolve_obstacle(const View& d, const StepRules& rules, std::uint32_t i, std::uint32_t k) {
  const Obstacle& o = (*rules.box.obstacles)[k];
  if (o.moves) [[unlikely]]
    return resolve_moving_wall(d, rules, i, o);
  return resolve_resting_obstacle(d, rules, i, o);
}

template <class View>
WallImpact resolve_wall_event(const View& d, const StepRules& rules, const ContactEvent& e) {
  if (is_obstacle(e.id2)) return resolve_obstacle(d, rules, e.i1, obstacle_of(e.id2));
  return resolve_wall(d, rules, e.i1, wall_side(e.id2));
}

template <class View>
Impact resolve_event(const View& d, const StepRules& rules, const ContactEvent& e) {
  if (is_wall(e.id2)) return resolve_wall_event(d, rules, e);
  return resolve_pair(d, rules, e.i1, e.i2);
}

// The first pass resolves all contacts in order of time. Further passes resolve the crowded ones (a disk of theirs has
// another contact in this step), until a pass finds no pair that still touches and approaches, or after
// most_impact_passes. Each pass hands the momentum of disks that pour onto a pile on by a layer; with a single pass
// they would be squeezed.
inline constexpr int most_impact_passes = 8;

}  // namespace carom
