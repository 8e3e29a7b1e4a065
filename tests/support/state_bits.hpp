// All of a state in bits, by which two runs that should agree are compared.
#pragma once

#include <string>

#include "core/disks/disk_columns.hpp"
#include "core/disks/state.hpp"
#include "io/checkpoint/checkpoint.hpp"

namespace carom::test {

// Storage order is free, so disks stand in the order of their ids.
inline std::string all_bits(const State& state) {
  State sorted = state;
  gather_disks(state.disks, by_id(state.disks), sorted.disks);
  return encode_checkpoint({}, sorted);
}

}  // namespace carom::test
