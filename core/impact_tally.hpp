// What the impacts of one step add to the counters. Its sums are exact, so parts of a step may be tallied apart, in any
// order, and added.
#pragma once

#include <array>
#include <cstddef>

#include "core/contact_event.hpp"
#include "core/exact_sum.hpp"
#include "core/resolve.hpp"
#include "core/state.hpp"

namespace carom {

struct ImpactTally {
  Count collisions = 0;
  Count wall_collisions = 0;
  Count amiss = 0;  // of both, see Impact
  ExactSum virial;
  std::array<ExactSum, 4> wall_impulse;

  // partner: the second disk's id, or a wall_partner.
  void add(DiskId partner, const Impact& impact) {
    if (!impact.happened) return;
    amiss += impact.amiss ? 1 : 0;
    if (is_wall(partner)) {
      ++wall_collisions;
      wall_impulse[static_cast<std::size_t>(wall_side(partner))].add(impact.virial);
    } else {
      ++collisions;
      virial.add(impact.virial);
    }
  }

  void add(const ImpactTally& other) {
    collisions += other.collisions;
    amiss += other.amiss;
    wall_collisions += other.wall_collisions;
    if (other.collisions > 0) virial.add(other.virial);
    if (other.wall_collisions > 0) {
      for (std::size_t k = 0; k < wall_impulse.size(); ++k) wall_impulse[k].add(other.wall_impulse[k]);
    }
  }

  // Rounds once a step.
  void count_into(Counters& counters) const {
    counters.collisions += collisions;
    counters.wall_collisions += wall_collisions;
    if (collisions > 0) counters.virial += virial.value();
    if (wall_collisions == 0) return;
    for (std::size_t k = 0; k < wall_impulse.size(); ++k) counters.wall_impulse[k] += wall_impulse[k].value();
  }
};

}  // namespace carom
