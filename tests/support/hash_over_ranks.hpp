// The hash of a state whose disks lie on several ranks.
#pragma once

#include <cstdint>

#include "core/disks/state_hash.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/ranks/ranks.hpp"

namespace carom::test {

// state_hash of all ranks' disks together.
inline std::uint64_t state_hash_over_ranks(Ranks& ranks, const Disks& own) {
  struct Part {
    std::uint64_t disks = 0, sum = 0;
  };
  Bytes here;
  put(here, Part{own.size(), sum_of_hashes(own)});
  Part all;
  for (const Bytes& there : ranks.gather(here)) {
    const auto part = MessageReader(there).get<Part>();
    all.disks += part.disks;
    all.sum += part.sum;
  }
  return state_hash(all.disks, all.sum);
}

}  // namespace carom::test
