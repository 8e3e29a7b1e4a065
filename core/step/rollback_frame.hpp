// The rules of a rollback frame that pairwise steps do not share: for which pairs it goes back, how they bounce, and
// when it stalls. Formula (23) and faults F1 to F11: docs/original.md.
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

// Is the event that of two approaching disks (F8)? Only those make the system go back; walls do not.
bool is_met(Disks& disks, const StepRules& rules, const ContactEvent& event);

// Enters the overlap of a contact of two disks, while all disks are where they drifted to. If the pair is met, the
// overlap when the frame began, since a wall may have pushed one disk into the other (F11); otherwise the present
// overlap, which the frame will not resolve. Contacts with walls are left out.
void note_overlaps(Disks& disks, const StepRules& rules, const ContactEvent& event, bool met, StepFigures& figures);

// Bounces a pair by (23) where it is now, if it still approaches: with its present velocities, not with copies (F3).
// After the roll-back some pairs do not touch yet and bounce at a distance: fault F2, which the method keeps.
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

// Does the pair bounce at a distance, because all disks went back by `back`, to before its contact (F2)? If one of its
// disks bounces in another pair as well, the pair might never have touched.
bool is_at_a_distance(const StepRules& rules, const ContactEvent& event, double back);

// Bounces every pair, in the order given. log: if not null, pairs that collide are added to it.
void bounce_all(Disks& disks, const StepRules& rules, const std::vector<ContactEvent>& events, ImpactTally& tally,
                CollisionLog* log = nullptr);

// Resolves the contacts of one disk with walls and obstacles: back to the contact, bounce, forward; then it is pushed
// inside (F11). Where an obstacle keeps it inside another one or beyond a side, that overlap is entered in `deepest`.
// No contact where an inner sink is an opening, as in for_each_wall_contact.
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

// The latest end of the frame that starts at state.time: t_end, or the next draw of Brownian displacements.
double frame_limit(const Scene& scene, const State& state, const StepClock& clock);

// The length of a frame: `step`, but all of `left`, the time to its latest end, if no more than rounding would remain.
// In a frame of such a length, rounding would decide whether a kick or a source's disk that is due at the end of the
// run comes.
double frame_length(double step, double left, double end);

// F1: with many disks every frame goes back by nearly its whole length and time all but stops. A run whose last 10000
// frames advanced time by less than one dt is stopped, with the figure and the remedy (PhysicsError). To be called
// after every frame. It counts in the state, so that an interrupted run stops at the same frame.
void check_stall(State& state, const Scene& scene);

}  // namespace carom
