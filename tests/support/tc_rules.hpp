// The TC model's rules, and a disk, for tests that go event by event.
#pragma once

#include "core/physics/exact_event.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom::test {

inline constexpr double contact_time = 0.5;

// A box 10 high and wide with walls of restitution 0.5, under the TC model.
inline ExactRules tc_rules() {
  ExactRules rules;
  rules.box = box_of(10.0, 10.0);
  rules.box.restitutions.fill(0.5);
  rules.restitution = 0.5;
  rules.contact_time = contact_time;
  rules.constant = false;
  return rules;
}

inline ExactDisk disk_at(double x, double y, double vx, double vy, double last_contact = -never) {
  ExactDisk a;
  a.path = {0.0, x, y, vx, vy};
  a.mass = 2.0;
  a.radius = 1.0;
  a.last_contact = last_contact;
  return a;
}

}  // namespace carom::test
