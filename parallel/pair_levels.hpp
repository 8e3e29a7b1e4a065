// Running a list of contacts in order, on many threads, with the bits of the serial order: contacts that share no disk
// commute exactly, so each contact only has to wait for the earlier ones of its own disks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/executor.hpp"

namespace carom {

// Level of a contact: 1 + the highest level of the earlier contacts of its disks. Within a level no disk occurs twice.
struct PairLevels {
  std::vector<std::uint32_t> order;  // indices into the list, level by level, ascending within one
  std::vector<std::uint32_t> start;  // of each level in order, levels + 1
  bool worthwhile = false;           // levels are wide enough to share out; else run serially
  // Scratch.
  std::vector<std::uint32_t> level;  // of each contact
  std::vector<std::uint32_t> last;   // of each disk; 0 outside a build
};

// contacts: anything with i1, i2 (storage indices; i2 is not looked at where wall(c)). disks: how many there are.
template <class Contact, class IsWall>
void build_levels(PairLevels& levels, const std::vector<Contact>& contacts, std::size_t disks, const Executor& executor,
                  IsWall&& wall);

// Contacts a level must have on average to pay for handing it to other threads.
inline constexpr std::size_t narrow_level = 512;
// Contacts of a level that one thread takes at a time.
inline constexpr std::size_t level_block = 512;

// task(k, block) for every contact k, in an order with the bits of 0, 1, 2, ... (or backwards). block numbers the piece
// of work within its level: partial results of a level may be kept by it.
template <class Task>
void run_levels(const PairLevels& levels, std::size_t count, bool backwards, const Executor& executor, Task&& task) {
  if (!levels.worthwhile) {
    for (std::size_t k = 0; k < count; ++k) task(backwards ? count - 1 - k : k, std::size_t{0});
    return;
  }
  const std::size_t n = levels.start.size() - 1;
  for (std::size_t l = 0; l < n; ++l) {
    const std::size_t at = backwards ? n - 1 - l : l;
    const std::size_t first = levels.start[at];
    executor.for_ranges(levels.start[at + 1] - first, level_block,
                        [&](std::size_t b, std::size_t begin, std::size_t end) {
                          for (std::size_t k = begin; k < end; ++k) task(levels.order[first + k], b);
                        });
  }
}

template <class Contact, class IsWall>
void build_levels(PairLevels& levels, const std::vector<Contact>& contacts, std::size_t disks, const Executor& executor,
                  IsWall&& wall) {
  levels.worthwhile = false;
  const std::size_t narrow = executor.grain(narrow_level);
  if (executor.threads() == 1 || contacts.size() < 2 * narrow) return;
  levels.last.resize(disks, 0);
  levels.level.resize(contacts.size());
  std::uint32_t highest = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    std::uint32_t level = levels.last[c.i1];
    if (!wall(c)) level = std::max(level, levels.last[c.i2]);
    ++level;
    levels.level[k] = level;
    levels.last[c.i1] = level;
    if (!wall(c)) levels.last[c.i2] = level;
    highest = std::max(highest, level);
  }
  for (const Contact& c : contacts) {
    levels.last[c.i1] = 0;
    if (!wall(c)) levels.last[c.i2] = 0;
  }
  if (contacts.size() / highest < narrow) return;
  levels.worthwhile = true;
  levels.start.assign(highest + 1, 0);
  for (const std::uint32_t l : levels.level) ++levels.start[l];
  for (std::size_t l = 1; l <= highest; ++l) levels.start[l] += levels.start[l - 1];
  levels.order.resize(contacts.size());
  for (std::size_t k = contacts.size(); k-- > 0;) {
    levels.order[--levels.start[levels.level[k]]] = static_cast<std::uint32_t>(k);
  }
  // Counting down has left start[l] at the first contact of level l; level 0 is empty, so shift by one.
  levels.start.erase(levels.start.begin());
  levels.start.push_back(static_cast<std::uint32_t>(contacts.size()));
}

}  // namespace carom
