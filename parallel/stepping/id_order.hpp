// The contacts of a step in order of ids: pairs (smaller id, larger id), a wall's partner counting as an id.
#pragma once

#include <cstdint>
#include <vector>

#include "core/physics/contact_event.hpp"
#include "core/physics/resolve.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// A contact with the ids of its disks: all that the sweeps need.
struct IdPair {
  std::uint64_t key;     // id1 << 32 | id2: keys are in order of (id1, id2)
  std::uint32_t i1, i2;  // where the disks are stored; twice the same for a wall

  DiskId id1() const { return static_cast<DiskId>(key >> 32); }
  DiskId id2() const { return static_cast<DiskId>(key); }
  ContactEvent event() const { return {0.0, id1(), id2(), i1, i2}; }
};

inline constexpr std::uint64_t id_key(DiskId id1, DiskId id2) {
  return std::uint64_t{id1} << 32 | id2;
}

// The contact event of a pair, with its time. Precondition: the disks have not moved since the search.
template <class View>
ContactEvent timed_event(const View& d, const StepRules& rules, const IdPair& p) {
  if (!is_wall(p.id2())) return pair_event(d, rules, p.i1, p.i2);
  if (is_obstacle(p.id2())) {
    return obstacle_event(d, rules, p.i1, obstacle_of(p.id2()), gap_to(d, rules.box, p.i1, p.id2()));
  }
  const Side side = wall_side(p.id2());
  return wall_event(d, rules, p.i1, side, reach_beyond_wall(side, d.x[p.i1], d.y[p.i1], d.radius(p.i1), rules.box));
}

struct IdOrder {
  std::vector<IdPair> found;   // in any order
  std::vector<IdPair> sorted;  // by key
  std::vector<std::uint32_t> counts;
};

// Sorts pairs.found into pairs.sorted. ids: a number above all first ids; a smaller one only makes the sort slower.
void sort_by_ids(IdOrder& pairs, DiskId ids, const Executor& executor);

}  // namespace carom
