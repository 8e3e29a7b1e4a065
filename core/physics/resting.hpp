// Contacts that bear load: a pile under gravity. A contact that would bounce for less than a step is not an impact but
// a support (Moreau; Jean: non-smooth contact dynamics). This file decides which contacts are supports and what overlap
// they keep; support_solver.hpp finds the loads.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/push_apart.hpp"
#include "core/physics/resolve.hpp"

namespace carom {

// Approach speed, in units of g dt, up to which a contact is a support and not an impact. A step adds g dt to a disk's
// speed and a stack of n disks passes on n g dt at its foot, so the bound must exceed the height of piles in disks for
// their foot to stay at rest; larger values take restitution from slow impacts inside crowds (a first-order error: the
// bound goes to 0 with dt). That holds for crowded contacts; a disk that only lies on a wall needs lying_rest.
inline constexpr double crowded_rest = 64.0;
inline constexpr double lying_rest = 2.0;

// Overlap that a loaded contact keeps: contact_slop in units of g dt^2, but at most largest_slop of the sum of radii
// (of the radius, at a wall). Loads are found to a tolerance, and the error moves a contact a little in each step; a
// contact that opened would lose its load and start a tremor. With 2 g dt^2 a silo of fifty layers never came to rest;
// from 10 on it did; with 16, 10^4 disks of radii 1 : 10 trembled for ever. A tall pile needs enough cycles
// (support_solver.hpp) not to sway within this slop.
inline constexpr double contact_slop = 64.0;
inline constexpr double largest_slop = 5e-3;

// Force on the contact in the step before; 0 if it bore none. loads are in ids_order.
inline double load_of(const std::vector<ContactLoad>& loads, const ContactEvent& e) {
  const auto it = std::lower_bound(loads.begin(), loads.end(), e, ids_order);
  return it != loads.end() && it->id1 == e.id1 && it->id2 == e.id2 ? it->force : 0.0;
}

// Relative velocity along the line of centres (at a wall, of the disk away from it); length / time, < 0: approaching.
template <class View>
double normal_velocity(const View& d, const Domain& box, const ContactEvent& e) {
  if (is_obstacle(e.id2)) return -speed_towards(gap_to(d, box, e.i1, e.id2), d.vx[e.i1], d.vy[e.i1]);
  if (is_wall(e.id2)) {
    const Side side = wall_side(e.id2);
    return -approach_speed(side, d.vx[e.i1], d.vy[e.i1], box.place(side));
  }
  const Relative r = relative(d, e.i1, e.i2, box);
  const double distance2 = r.distance2();
  return distance2 > 0.0 ? r.approach() / std::sqrt(distance2) : 0.0;
}

// How a contact stands among the others of its step.
struct ContactStatus {
  bool loaded = false;   // it bore load in the step before
  bool crowded = false;  // one of its disks has another contact
};

// Is this contact a support?
template <class View>
bool is_support(const View& d, const StepRules& rules, const ContactEvent& e, ContactStatus status) {
  if (is_wall(e.id2) && !is_obstacle(e.id2) && rules.box.is_thermal(wall_side(e.id2))) return false;
  if (status.loaded && status.crowded) return true;
  const double speed = std::abs(normal_velocity(d, rules.box, e));
  if (status.crowded) return speed <= crowded_rest * rules.gravity.size * rules.dt;
  const bool lies = is_wall(e.id2) && may_lose_energy(d, rules, e);
  return lies && speed <= lying_rest * rules.gravity.size * rules.dt;
}

// Is this contact solved together with the others (support_solver.hpp)? Supports are. So are all crowded contacts that
// dissipate: the loads of others may press them together, and in a crowd impacts one after another need not end.
template <class View>
bool is_solved(const View& d, const StepRules& rules, const ContactEvent& e, ContactStatus status) {
  return (status.crowded && may_lose_energy(d, rules, e)) || is_support(d, rules, e, status);
}

// The overlap that a loaded contact keeps; length. A step that is shorter than the others, such as the last one of a
// run, keeps as much as they do: otherwise it would push the whole pile up.
template <class View>
double slack_of(const View& d, const StepRules& rules, const ContactEvent& e) {
  const double contact_distance = is_wall(e.id2) ? d.radius(e.i1) : d.radius(e.i1) + d.radius(e.i2);
  const double dt = std::max(rules.dt, rules.whole_dt);
  return std::min(contact_slop * rules.gravity.size * dt * dt, largest_slop * contact_distance);
}

// A disk that bears on a wall stays on it: if its loads have lifted it off by less than slack (length), it is put back.
// Otherwise a step shorter than the one before would not find the contact.
template <class View>
void hold_at_wall(const View& d, const Domain& box, const ContactEvent& e, double slack) {
  if (is_obstacle(e.id2)) {
    const ObstacleGap gap = gap_to(d, box, e.i1, e.id2);
    if (gap.beyond >= 0.0 || gap.beyond < -slack) return;
    d.x[e.i1] += gap.beyond * gap.nx;
    d.y[e.i1] += gap.beyond * gap.ny;
    return;
  }
  const Side side = wall_side(e.id2);
  const double r = d.radius(e.i1);
  const double beyond = reach_beyond_wall(side, d.x[e.i1], d.y[e.i1], r, box);
  if (beyond >= 0.0 || beyond < -slack) return;
  (side == Side::left || side == Side::right ? d.x : d.y)[e.i1] = touching_coordinate(side, r, box);
}

// Pushes a contact apart in one sweep: any contact in the first sweep, only crowded and deep ones later.
// status.loaded: it bore load in this step, not in the one before. Returns whether it was pushed.
template <class View>
bool push_in_sweep(const View& d, const StepRules& rules, const ContactEvent& e, int sweep, ContactStatus status) {
  const bool loaded = status.loaded;
  const double slack = loaded ? slack_of(d, rules, e) : 0.0;
  if (sweep > 0 && (!status.crowded || !is_deep(d, rules.box, e, overlap_to_push(sweep, loaded), slack))) return false;
  if (sweep == 0 && loaded && is_wall(e.id2)) hold_at_wall(d, rules.box, e, slack);
  push_apart(d, rules.box, e, slack);
  return true;
}

}  // namespace carom
