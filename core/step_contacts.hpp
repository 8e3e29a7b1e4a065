// The contacts of one step of `pairwise`, from the list of events to disks that no longer overlap. Serial: the
// reference.
#pragma once

#include <vector>

#include "core/collision_log.hpp"
#include "core/contact_event.hpp"
#include "core/resolve.hpp"
#include "core/state.hpp"
#include "core/validity.hpp"

namespace carom {

// What disks that collide late overlapped by, over the sum of their radii, as far as it tells that something is wrong:
// a few per cent are what disks move in any step, and the next one sees to them.
inline constexpr double least_late_overlap = 0.1;
inline double telling_overlap(float late) {
  const auto overlap = static_cast<double>(late);
  return overlap > least_late_overlap ? overlap : 0.0;
}

// Pair and wall contacts at the end of a drift of length rules.dt, in no particular order.
std::vector<ContactEvent> find_contacts(Disks& disks, const StepRules& rules);

// Impacts in order of contact, then supports (settling scenes), then pushing apart; counts into state.counters and
// keeps the loads in state.loads. Sorts events. Returns what went wrong. Pairs that collide are added to log, where one
// is given.
StepFigures resolve_contacts(State& state, const StepRules& rules, std::vector<ContactEvent>& events,
                             CollisionLog* log = nullptr);

}  // namespace carom
