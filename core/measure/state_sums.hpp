// What a summary says of all disks of a state together, for a program that need not have them at the same time.
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

// The sums from disks that come in pieces: the bits of energy_of and momentum_of all the same.
class StateTally {
 public:
  StateTally(const Scene& scene, double time) : scene_(scene), box_(box_at(scene.box, time)) { sums_.at.time = time; }

  // The next disks in order of id; order: by_id(disks).
  void add(const Disks& disks, const std::vector<std::size_t>& order);

  StateSums sums() const;

 private:
  const Scene& scene_;
  Domain box_;
  StateSums sums_;
  std::uint64_t hashes_ = 0;
  BlockedTally kinetic_, potential_, rotational_, relative_, px_, py_, magnitude_;
};

// Of a state with all disks.
StateSums sums_of(const State& state, const Scene& scene);
DeepestOverlaps overlaps_of(const State& state, const Scene& scene);

}  // namespace carom
