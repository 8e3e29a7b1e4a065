// Counts the contacts of a disk in a step.
#pragma once

#include <atomic>
#include <cstdint>

namespace carom {

// It only matters whether a disk has no contact, one, or more. A count of 16 bits would overflow to 1 at 65,537
// contacts, so from this number on it no longer grows.
inline constexpr std::uint16_t many_contacts = 0x8000;

inline void count_contact(std::uint16_t& contacts) {
  if (contacts < many_contacts) ++contacts;
}

// For several threads at once. Counts are sums of ones, so the order does not matter; they exceed many_contacts by at
// most one for each thread.
inline void count_contact_shared(std::uint16_t& contacts) {
  const std::atomic_ref<std::uint16_t> count(contacts);
  if (count.fetch_add(1, std::memory_order_relaxed) >= many_contacts) [[unlikely]] {
    count.fetch_sub(1, std::memory_order_relaxed);
  }
}

}  // namespace carom
