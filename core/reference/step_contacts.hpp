// Resolves the contacts of one step of `pairwise`, serially: from the list of events to disks that no longer overlap.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/collision_log.hpp"
#include "core/disks/state.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/resolve.hpp"
#include "core/physics/wall_overlap.hpp"
#include "core/step/overlap_before.hpp"
#include "core/step/validity.hpp"

namespace carom {

// Enters the overlap of disk i with walls at the end of the step. To be called once for each disk in contact; others
// have none.
template <class View>
void raise_to_wall_overlap(const View& d, const Domain& box, std::uint32_t i, StepFigures& figures) {
  raise_to_wall_overlap(d.x[i], d.y[i], d.radius(i), d.id[i], box, figures.wall);
}

// Enters the overlap of the two disks of a contact at the end of the step. Does nothing for a contact with a wall.
template <class View>
void note_overlap_left(const View& d, const Domain& box, const ContactEvent& e, StepFigures& figures) {
  if (is_wall(e.id2)) return;
  const double contact_distance = d.radius(e.i1) + d.radius(e.i2);
  const double distance2 = distance2_of(d, e.i1, e.i2, box);
  // No square root for an overlap that is certainly not the deepest: in a pile every contact overlaps a little.
  constexpr double deep = 0.5, above_rounding = 1.0 + 1e-14;
  const double seen = figures.left.size < deep ? contact_distance * (1.0 - figures.left.size) : contact_distance;
  if (distance2 >= contact_distance * contact_distance || distance2 > seen * seen * above_rounding) return;
  figures.left.raise_to({(contact_distance - std::sqrt(distance2)) / contact_distance, e.id1, e.id2});
}

// Number of contacts of each disk, by storage index. A disk with two or more is crowded, and so are its contacts.
std::vector<std::uint32_t> contacts_per_disk(std::size_t disks, const std::vector<ContactEvent>& events);
inline bool is_crowded(const std::vector<std::uint32_t>& contacts, const ContactEvent& e) {
  return contacts[e.i1] > 1 || (!is_wall(e.id2) && contacts[e.i2] > 1);
}

// Pair and wall contacts at the end of a drift of length rules.dt, in no particular order.
std::vector<ContactEvent> contacts_after_drift(Disks& disks, const StepRules& rules);

// Impacts in order of contact, then supports (settling scenes), then pushing apart; counts into state.counters and
// keeps the loads in state.loads. Sorts events. Returns the errors of the step. log: if not null, pairs that collide
// are added to it.
StepFigures resolve_serially(State& state, const StepRules& rules, std::vector<ContactEvent>& events,
                             CollisionLog* log = nullptr);

}  // namespace carom
