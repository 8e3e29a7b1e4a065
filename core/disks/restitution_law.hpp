// The restitution of two disks if it depends on their groups or on the speed of approach.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/types.hpp"

namespace carom {

// Restitution of two disks: a number, or e(v) = max(least, 1 - a v^(1/5)), v the speed of approach along the line of
// centres.
struct Restitution {
  double least = 1.0;      // in [0, 1]; the number itself where viscosity is 0
  double viscosity = 0.0;  // a; (time / length)^(1/5)
  bool operator==(const Restitution&) const = default;
};

// The restitution of two groups. Groups are numbered as their [[disks]] blocks, from 0; all disks from sources have the
// number after the last.
struct GroupPair {
  DiskId first = 0, second = 0;  // first <= second
  Restitution restitution;
};

inline bool operator<(const GroupPair& a, const GroupPair& b) {
  return std::pair(a.first, a.second) < std::pair(b.first, b.second);
}

// What a scene gives in addition to one number for all pairs.
struct RestitutionLaw {
  double viscosity = 0.0;        // of the pairs that are not in `pairs`
  std::vector<DiskId> ends;      // the id after the last of each group, ascending; only beside pairs
  std::vector<GroupPair> pairs;  // in order, no two of the same groups

  // Is one number enough?
  bool is_empty() const { return viscosity == 0.0 && pairs.empty(); }

  // Restitution of the disks with these ids. number: the scene's number for all other pairs.
  Restitution of(double number, DiskId a, DiskId b) const {
    if (pairs.empty()) return {number, viscosity};
    const auto group = [&](DiskId id) {
      return static_cast<DiskId>(std::upper_bound(ends.begin(), ends.end(), id) - ends.begin());
    };
    GroupPair asked{group(a), group(b), {number, viscosity}};
    if (asked.second < asked.first) std::swap(asked.first, asked.second);
    const auto it = std::lower_bound(pairs.begin(), pairs.end(), asked);
    return it == pairs.end() || asked < *it ? asked.restitution : it->restitution;
  }

  // May a collision of two disks of `pairs` lose energy?
  bool dissipates() const {
    return std::any_of(pairs.begin(), pairs.end(), [](const GroupPair& p) { return p.restitution.least < 1.0; });
  }
};

}  // namespace carom
