// The overlap that two disks in contact had before the step; it needs no search of its own.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/physics/contact_of_step.hpp"
#include "core/step/validity.hpp"

namespace carom {

// Enters the overlap that disks i and j had when the step began: impacts of the step before may have pushed together
// disks that were not in contact then. To be called before any contact is resolved, while the disks are on the paths of
// their drift.
template <class View>
void note_overlap_before(const View& d, const StepRules& rules, std::uint32_t i, std::uint32_t j,
                         StepFigures& figures) {
  const Relative r = relative(d, i, j, rules.box);
  const double dx = r.dx - r.dvx * rules.dt;
  const double dy = r.dy - r.dvy * rules.dt;
  const double contact_distance = d.radius(i) + d.radius(j);
  const double distance2 = dx * dx + dy * dy;
  if (distance2 < contact_distance * contact_distance) {
    figures.before.raise_to({(contact_distance - std::sqrt(distance2)) / contact_distance, d.id[i], d.id[j]});
  }
}

}  // namespace carom
