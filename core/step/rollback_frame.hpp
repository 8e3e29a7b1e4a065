// The parts of one rollback frame that are its own: which pairs it goes back for, how they bounce, and when it stalls.
// Formula (23) and faults F1 to F11: docs/original.md.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/collision_log.hpp"
#include "core/disks/state.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/physics/push_apart.hpp"
#include "core/physics/resolve.hpp"
#include "core/physics/wall_overlap.hpp"
#include "core/scene/scene.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/validity.hpp"

namespace carom {

// Is the event a pair of disks that approaches (F8)? Walls do not make the system go back.
bool is_met(Disks& disks, const StepRules& rules, const ContactEvent& event);

// The overlaps that a contact of the frame shows, while all disks are where they drifted to: of a pair that is met,
// what it had when the frame began, as a wall may have sent one disk into the other (F11); of any other pair that of
// now, which nothing in the frame will see to. None of a wall.
void note_overlaps(Disks& disks, const StepRules& rules, const ContactEvent& event, bool met, StepFigures& figures);

// A pair found bounces by (23) where it is now, if it still approaches: with the velocities of the moment, not copies
// (F3). A pair that has not yet touched bounces at a distance: F2, kept.
template <class View>
PairImpact bounce_pair(const View& d, const StepRules& rules, std::uint32_t i, std::uint32_t j) {
  const Relative r = relative(d, i, j, rules.box);
  if (!(r.approach() < 0.0)) return {};
  const double e = pair_restitution(d, rules, i, j, r);
  const Shares share = shares_of(d, i, j);
  const double before = d.vx[j];
  const double change = collide(r, share, e, d.vx[i], d.vy[i], d.vx[j], d.vy[j]);
  PairImpact impact{.virial = reduced_mass(d.mass(i), d.mass(j)) * change, .happened = true};
  rub_pair(d, rules, i, j, r, share, change);
  record_shear_of(d, rules, i, j, r, before, impact);
  return impact;
}

// Had the pair met not yet touched, now that all disks have gone back by `back` (F2)? Where one of its disks bounces in
// another pair as well, it might never have.
bool is_at_a_distance(const StepRules& rules, const ContactEvent& event, double back);

// Every pair, in the order given; those that collide are added to log, where one is given.
void bounce_all(Disks& disks, const StepRules& rules, const std::vector<ContactEvent>& events, ImpactTally& tally,
                CollisionLog* log = nullptr);

// One disk and the walls and obstacles it reaches beyond: back to its contact, bounce, forward; what remains is pushed
// inside (F11). An obstacle may hold a disk in another, or in a side: it raises `deepest`. No walls where an inner sink
// is an opening, as in for_each_wall_contact.
template <class View>
void meet_walls(const View& d, const StepRules& rules, std::uint32_t i, ImpactTally& tally, Overlap& deepest) {
  const double open = depth_of_opening(d, rules.box, i);
  for (Side side : all_sides) {
    if (rules.box.side(side) != SideKind::wall) continue;
    if (open >= 0.0 && reach_beyond_wall(side, d.x[i], d.y[i], d.radius(i), rules.box) <= open) continue;
    tally.add_wall(wall_partner(side), resolve_wall(d, rules, i, side));
    push_wall(d, rules.box, i, side, 0.0);
  }
  if (rules.box.obstacles == nullptr) return;
  bool touched = false;
  const double x = d.x[i], y = d.y[i], r = d.radius(i);
  for_each_solid_touched_in_order(rules.box, x, y, r, [&](std::uint32_t k, const ObstacleGap& gap) {
    if (gap.beyond <= open || is_hidden(rules.box, k, gap, x, y, r)) return;
    touched = true;
    tally.add_wall(obstacle_partner(k), resolve_obstacle(d, rules, i, k));
    push_from_obstacle(d, rules.box, i, (*rules.box.obstacles)[k], 0.0);
  });
  if (touched) raise_to_wall_overlap(d.x[i], d.y[i], d.radius(i), d.id[i], rules.box, deepest);
}

// Where the frame that starts at state.time must end: at t_end, or at the next draw of Brownian displacements.
double frame_limit(const Scene& scene, const State& state, const StepClock& clock);

// How long a frame is that lasts `step`, with `left` of the time to where it must end: all of it, if what it left would
// be rounding of the sum of frames. A frame of that would do what is due at a run's end, a kick or a source's disk, or
// not, as rounding has it.
double frame_length(double step, double left, double end);

// F1: with many disks every frame goes back by nearly its whole length and time all but stops. A run whose last 10000
// frames advanced time by less than one dt is stopped, with the figure and the remedy (PhysicsError). To be called
// after every frame; what it remembers is in the state, so that a run that was interrupted stops at the same frame.
void check_stall(State& state, const Scene& scene);

}  // namespace carom
