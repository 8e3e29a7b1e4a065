// The fingerprint of a state, in every summary and in the golden tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/disks/disks.hpp"

namespace carom {

// 64-bit hash of (id, x, y, vx, vy), and the spin of rough disks, as bit patterns; -0.0 and 0.0 differ. A sum over
// disks of a mixed hash of each, so it does not depend on storage order and can be taken in parallel.
std::uint64_t state_hash(const Disks& disks);

// The same in two steps, for disks in several parts: first the sum of hashes of each part, then the hash of all disks
// from the sum of those sums.
std::uint64_t sum_of_hashes(const Disks& part);
std::uint64_t state_hash(std::size_t disks, std::uint64_t sum);

// 16 lower-case hexadecimal digits.
std::string hash_text(std::uint64_t hash);

}  // namespace carom
