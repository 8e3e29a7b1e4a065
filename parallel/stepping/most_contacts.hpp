// Limits of the 32-bit indices of a step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "core/base/check.hpp"

namespace carom {

// The contacts of a step, and the slots of its supports (SupportBatches): the last number means none.
inline constexpr std::size_t most_contacts = std::numeric_limits<std::uint32_t>::max() - std::size_t{1};

// The disks of a pile: velocities are indexed by twice the number of a disk, and after all disks come the spare ones of
// the patches (SupportBatches).
inline constexpr std::size_t most_disks_of_pile = (std::size_t{1} << 31U) - (std::size_t{1} << 20U);

// Throws RunError if count > most. what: the name of the counted things.
inline void check_numbered(std::size_t count, std::size_t most, const char* what) {
  if (count <= most) return;
  throw RunError("pairwise: " + std::to_string(count) + " " + what + " are more than one process can number, " +
                 std::to_string(most) + "; run the scene on several ranks");
}

inline void check_contacts(std::size_t contacts) {
  check_numbered(contacts, most_contacts, "contacts in a step");
}

}  // namespace carom
