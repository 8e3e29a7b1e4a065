// The contacts of one step of `pairwise`, from the list of events to disks that no longer overlap. Serial: the
// reference.
#pragma once

#include <vector>

#include "core/collision_log.hpp"
#include "core/contact_event.hpp"
#include "core/resolve.hpp"
#include "core/state.hpp"

namespace carom {

// Pair and wall contacts at the end of a drift of length rules.dt, in no particular order.
std::vector<ContactEvent> find_contacts(Disks& disks, const StepRules& rules);

// Impacts in order of contact, then supports (settling scenes), then pushing apart; counts into state.counters and
// keeps the loads in state.loads. Sorts events. Pairs that collide are added to log, where one is given.
void resolve_contacts(State& state, const StepRules& rules, std::vector<ContactEvent>& events,
                      CollisionLog* log = nullptr);

}  // namespace carom
