// All of a state in bits, by which two runs that should agree are compared.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "io/checkpoint/checkpoint.hpp"

namespace carom::test {

// Storage order is free, so disks stand in the order of their ids.
inline std::string all_bits(const State& state) {
  State sorted = state;
  const std::vector<std::size_t> order = by_id(state.disks);
  const auto sort = [&](auto& to, const auto& from) {
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[order[k]];
  };
  Disks& d = sorted.disks;
  sort(d.x, state.disks.x);
  sort(d.y, state.disks.y);
  sort(d.vx, state.disks.vx);
  sort(d.vy, state.disks.vy);
  sort(d.id, state.disks.id);
  sort(d.radius, state.disks.radius);
  sort(d.mass, state.disks.mass);
  sort(d.spin, state.disks.spin);
  return encode_checkpoint({}, sorted);
}

}  // namespace carom::test
