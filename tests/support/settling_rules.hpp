// The rules of disks that settle, and a contact of two, for tests that go contact by contact.
#pragma once

#include "core/physics/contact_event.hpp"
#include "core/physics/step_rules.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom::test {

inline constexpr double settling_gravity = 2.0, settling_dt = 0.01;

// A box 20 by 10 with walls of restitution 0.5, disks of 0.5 too.
inline StepRules settling_rules() {
  StepRules rules{box_of(20.0, 10.0), settling_gravity, 0.5, settling_dt, true};
  rules.box.restitutions.fill(0.5);
  return rules;
}

inline ContactEvent contact_of(DiskId id1, DiskId id2) {
  return {0.0, id1, id2, id1, is_wall(id2) ? 0U : id2};
}

}  // namespace carom::test
