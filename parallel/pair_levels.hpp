// Running a list of contacts in order, on many threads, with the bits of the serial order: contacts that share no disk
// commute exactly, so each contact only has to wait for the earlier ones of its own disks.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

#include "parallel/executor.hpp"

namespace carom {

// Level of a contact: 1 + the highest level of the earlier contacts of its disks. Within a level no disk occurs twice.
struct PairLevels {
  std::vector<std::uint32_t>
      order;  // indices into the list, level by level, within one by where the first disk is stored
  std::vector<std::size_t> start;  // of each level in order, levels + 1
  bool worthwhile = false;         // levels are wide enough to share out; else run serially
  // Scratch.
  std::vector<std::uint32_t> level;     // of each contact
  std::vector<std::uint32_t> last;      // of each disk; 0 outside a build
  std::vector<std::uint32_t> place;     // of each disk's contacts in by_place
  std::vector<std::uint32_t> by_place;  // contacts by where their first disk is stored
  std::vector<std::size_t> cursor;      // of each share of each level
};

// contacts: anything with i1, i2 (storage indices; i2 is not looked at where wall(c)). disks: how many there are.
template <class Contact, class IsWall>
void build_levels(PairLevels& levels, const std::vector<Contact>& contacts, std::size_t disks, const Executor& executor,
                  IsWall&& wall);

// Contacts a level must have on average to pay for sharing it out. Measured on a pile of 10^5 disks, 6,000 contacts a
// level: two threads then took 1.3 to 1.6 times as long as one in the serial order, since the records of the contacts
// are read in scattered order and from the other thread's cache. Records stored level by level should allow far less.
inline constexpr std::size_t narrow_level = 16384;
// Contacts of a level that one thread takes at a time: a microsecond or two of work, against a tenth for taking it.
inline constexpr std::size_t level_block = 64;

// task(k, slot) for every contact k, in an order with the bits of 0, 1, 2, ... (or backwards). slot <
// executor.threads() tells apart the pieces of work that may run at the same time: partial results that do not depend
// on order may be kept by it. Every thread has its share of each level, the same part of the box in all of them, so
// that disks stay in its cache; whoever is done helps the others and then waits for the level to end. It waits for
// threads that are running only: one alone gets through too.
template <class Task>
void run_levels(PairLevels& levels, std::size_t count, bool backwards, const Executor& executor, Task&& task) {
  if (!levels.worthwhile) {
    for (std::size_t k = 0; k < count; ++k) task(backwards ? count - 1 - k : k, std::size_t{0});
    return;
  }
  const auto shares = static_cast<std::size_t>(executor.threads());
  const std::size_t depth = levels.start.size() - 1;
  const std::size_t block = executor.grain(level_block);
  levels.cursor.assign(depth * shares, 0);
  std::atomic<std::size_t> done{0};
  executor.run(shares, [&](std::size_t slot) {
    for (std::size_t n = 0; n < depth; ++n) {
      const std::size_t l = backwards ? depth - 1 - n : n;
      const std::size_t first = levels.start[l];
      const std::size_t size = levels.start[l + 1] - first;
      for (std::size_t q = 0; q < shares; ++q) {
        const std::size_t share = (slot + q) % shares;
        const std::size_t begin = first + size * share / shares;
        const std::size_t end = first + size * (share + 1) / shares;
        std::atomic_ref<std::size_t> cursor(levels.cursor[l * shares + share]);
        for (std::size_t k = begin + cursor.fetch_add(block); k < end; k = begin + cursor.fetch_add(block)) {
          const std::size_t stop = std::min(end, k + block);
          for (std::size_t at = k; at < stop; ++at) task(levels.order[at], slot);
          done.fetch_add(stop - k, std::memory_order_release);
        }
      }
      const std::size_t all = backwards ? count - first : first + size;
      for (int spins = 0; done.load(std::memory_order_acquire) < all; ++spins) {
        if (spins > 1000) std::this_thread::yield();
      }
    }
  });
}

template <class Contact, class IsWall>
void build_levels(PairLevels& levels, const std::vector<Contact>& contacts, std::size_t disks, const Executor& executor,
                  IsWall&& wall) {
  levels.worthwhile = false;
  const std::size_t narrow = executor.grain(narrow_level);
  const std::size_t n = contacts.size();
  if (executor.threads() == 1 || n < 2 * narrow) return;
  levels.last.resize(disks, 0);
  levels.level.resize(n);
  levels.place.assign(disks + 1, 0);
  std::uint32_t highest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Contact& c = contacts[k];
    const bool pair = !wall(c);
    std::uint32_t level = levels.last[c.i1];
    if (pair) level = std::max(level, levels.last[c.i2]);
    levels.level[k] = level;
    highest = std::max(highest, level);
    levels.last[c.i1] = level + 1;
    if (pair) levels.last[c.i2] = level + 1;
    ++levels.place[c.i1 + 1];
  }
  std::fill(levels.last.begin(), levels.last.end(), 0U);
  if (n / (highest + std::size_t{1}) < narrow) return;
  levels.worthwhile = true;
  for (std::size_t i = 0; i < disks; ++i) levels.place[i + 1] += levels.place[i];
  levels.by_place.resize(n);
  for (std::size_t k = 0; k < n; ++k) levels.by_place[levels.place[contacts[k].i1]++] = static_cast<std::uint32_t>(k);
  levels.start.assign(highest + std::size_t{2}, 0);
  for (std::size_t k = 0; k < n; ++k) ++levels.start[levels.level[k] + 1];
  for (std::size_t l = 0; l <= highest; ++l) levels.start[l + 1] += levels.start[l];
  levels.order.resize(n);
  std::vector<std::size_t>& next = levels.cursor;
  next.assign(levels.start.begin(), levels.start.end());
  for (const std::uint32_t k : levels.by_place) levels.order[next[levels.level[k]]++] = k;
}

}  // namespace carom
