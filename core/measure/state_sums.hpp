// Sums over the disks of a state, for the summary; they can be taken in pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/state.hpp"
#include "core/measure/blocked_tally.hpp"
#include "core/measure/run_start.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct StateSums {
  RunStart at;                                  // of this state: disks, time, energy, momentum
  double smallest_radius = 0.0, fastest = 0.0;  // length; length / time; 0 without disks
  std::uint64_t hash = 0;                       // state_hash
};

struct DeepestOverlaps {
  Overlap disks, wall;
};

// The sums from disks that come in pieces, with the bits of energy_of and momentum_of.
class StateTally {
 public:
  StateTally(const Scene& scene, double time) : scene_(scene), box_(box_at(scene.box, time)) { sums_.at.time = time; }

  // Adds the next piece, in order of id; order: by_id(disks).
  void add(const Disks& disks, const std::vector<std::size_t>& order);

  StateSums sums() const;

 private:
  const Scene& scene_;
  Domain box_;
  StateSums sums_;
  std::uint64_t hashes_ = 0;
  BlockedTally kinetic_, potential_, rotational_, relative_, px_, py_, magnitude_;
};

// The sums of a state that has all disks.
StateSums sums_of(const State& state, const Scene& scene);
DeepestOverlaps overlaps_of(const State& state, const Scene& scene);

}  // namespace carom
