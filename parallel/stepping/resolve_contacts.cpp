#include "parallel/stepping/resolve_contacts.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "core/physics/push_apart.hpp"
#include "core/physics/resting.hpp"
#include "core/reference/step_contacts.hpp"
#include "parallel/stepping/contact_count.hpp"
#include "parallel/stepping/finish_disk.hpp"
#include "parallel/stepping/resolve_crowded.hpp"
#include "parallel/stepping/wall_reach.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

namespace {

void count_event(std::vector<std::uint16_t>& contacts, const ContactEvent& e) {
  count_contact_shared(contacts[e.i1]);
  if (!is_wall(e.id2)) count_contact_shared(contacts[e.i2]);
}

// The disks of successive contacts are far apart in memory. They are prefetched this many contacts ahead, about as long
// as memory takes to answer.
constexpr std::size_t ahead = 8;

template <class View>
void prefetch_disk(const View& d, std::uint32_t i) {
  __builtin_prefetch(d.x + i, 1);
  __builtin_prefetch(d.y + i, 1);
  __builtin_prefetch(d.vx + i, 1);
  __builtin_prefetch(d.vy + i, 1);
  __builtin_prefetch(d.id + i);
}

// Counts the contacts of each disk, in lists.contacts.
void count_found(const FoundContacts& found, std::size_t disks, const Executor& executor, ContactLists& lists) {
  lists.contacts.resize(disks, 0);
  // On one thread without atomic operations, each of which would wait for all stores before it.
  const bool shared = executor.threads() > 1;
  executor.run_alike(found.used, [&](std::size_t b) {
    const std::vector<Pair>& pairs = found.buffers[b];
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (k + ahead < pairs.size()) {
        __builtin_prefetch(&lists.contacts[pairs[k + ahead].i1], 1);
        __builtin_prefetch(&lists.contacts[pairs[k + ahead].i2], 1);
      }
      for (const std::uint32_t i : {pairs[k].i1, pairs[k].i2}) {
        shared ? count_contact_shared(lists.contacts[i]) : count_contact(lists.contacts[i]);
      }
    }
  });
  executor.run_alike(found.walls.size(), [&](std::size_t b) {
    for (const ContactEvent& e : found.walls[b]) count_event(lists.contacts, e);
  });
}

// Prepares empty lists for this number of blocks.
void begin_blocks(std::size_t blocks, ContactLists& lists) {
  while (lists.crowded_blocks.size() < blocks) {
    lists.crowded_blocks.emplace_back();
    lists.crowded_blocks.back().reserve(contact_block / 8);
  }
  for (std::size_t b = 0; b < blocks; ++b) lists.crowded_blocks[b].clear();
  lists.crowded.reserve(contact_block);
  lists.tallies.assign(blocks, {});
  lists.largest.assign(blocks, 0.0);
  assign_amply(lists.seen, blocks, {});
}

// Resolves those pairs of block b of the search that are alone; the others become events. All called functions are
// inlined: calls were a third of its instructions.
template <class View>
[[gnu::flatten]] void resolve_alone_pairs(const View& d, const StepRules& rules, const WallReach& walls,
                                          const std::vector<Pair>& pairs, std::size_t b, ContactLists& lists) {
  StepFigures& seen = lists.seen[b];
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = in_id_order(d.id, pairs[k]);
    if (k + ahead < pairs.size()) {
      prefetch_disk(d, pairs[k + ahead].i1);
      prefetch_disk(d, pairs[k + ahead].i2);
    }
    note_overlap_before(d, rules, i, j, seen);
    if (lists.contacts[i] != 1 || lists.contacts[j] != 1) {
      lists.crowded_blocks[b].push_back(pair_event(d, rules, i, j));
      continue;
    }
    lists.tallies[b].template add_pair<View::is_sheared>(resolve_pair(d, rules, i, j));
    push_pair(d, rules.box, i, j, 0.0);
    note_overlap_left(d, rules.box, {0.0, d.id[i], d.id[j], i, j}, seen);
    const double v2 = std::max(finish_disk(d, rules.box, walls, i, seen), finish_disk(d, rules.box, walls, j, seen));
    lists.largest[b] = std::max(lists.largest[b], v2);
    lists.contacts[i] = lists.contacts[j] = 0;
  }
}

// The same for wall contacts.
template <class View>
void resolve_alone_walls(const View& d, const StepRules& rules, const WallReach& walls,
                         const std::vector<ContactEvent>& events, std::size_t b, ContactLists& lists) {
  for (const ContactEvent& e : events) {
    if (lists.contacts[e.i1] != 1) {
      lists.crowded_blocks[b].push_back(e);
      continue;
    }
    lists.tallies[b].add_wall(e.id2, resolve_wall_event(d, rules, e));
    push_apart(d, rules.box, e, 0.0);
    lists.largest[b] = std::max(lists.largest[b], finish_disk(d, rules.box, walls, e.i1, lists.seen[b]));
    lists.contacts[e.i1] = 0;
  }
}

// Resolves the contacts that are alone, each from impact to pushing and wrapping in one visit; they commute with all
// others, so the blocks may run in any order. The other contacts become events in lists.crowded, in canonical order of
// time.
template <class View>
double resolve_alone(const View& d, const StepRules& rules, const FoundContacts& found, std::size_t disks,
                     const Executor& executor, ContactLists& lists, ImpactTally& tally) {
  count_found(found, disks, executor, lists);
  const std::size_t blocks = found.used + found.walls.size();
  begin_blocks(blocks, lists);
  const WallReach reach(rules.box);
  executor.run_alike(found.used,
                     [&](std::size_t b) { resolve_alone_pairs(d, rules, reach, found.buffers[b], b, lists); });
  executor.run_alike(found.walls.size(), [&](std::size_t w) {
    resolve_alone_walls(d, rules, reach, found.walls[w], found.used + w, lists);
  });
  add_seen(lists);
  collect_crowded(blocks, executor, lists, tally);
  return blocks == 0 ? 0.0 : *std::max_element(lists.largest.begin(), lists.largest.end());
}

// Calls finish(i, block) once for each disk i of these events, and clears its count. Returns the largest result.
template <class Finish>
double finish_each(const std::vector<ContactEvent>& events, const Executor& executor, ContactLists& lists,
                   Finish&& finish) {
  lists.largest.assign(executor.blocks(events.size(), contact_block), 0.0);
  executor.for_ranges(events.size(), contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    // The thread that clears the count finishes the disk; which thread that is does not change the result.
    const auto finish_once = [&](std::uint32_t i) {
      if (std::atomic_ref<std::uint16_t>(lists.contacts[i]).exchange(0, std::memory_order_relaxed) == 0) return;
      lists.largest[b] = std::max(lists.largest[b], finish(i, b));
    };
    for (std::size_t k = begin; k < end; ++k) {
      finish_once(events[k].i1);
      if (!is_wall(events[k].id2)) finish_once(events[k].i2);
    }
  });
  return lists.largest.empty() ? 0.0 : *std::max_element(lists.largest.begin(), lists.largest.end());
}

// Finishes the disks of the crowded contacts. Returns the largest squared speed among them.
template <class View>
double finish_crowded(const View& d, const Domain& box, const Executor& executor, ContactLists& lists) {
  const WallReach walls(box);
  assign_amply(lists.seen, executor.blocks(lists.crowded.size(), contact_block), {});
  const double speed2 = finish_each(lists.crowded, executor, lists, [&](std::uint32_t i, std::size_t b) {
    return finish_disk(d, box, walls, i, lists.seen[b]);
  });
  add_seen(lists);
  return speed2;
}

}  // namespace

void add_seen(ContactLists& lists) {
  for (const StepFigures& block : lists.seen) lists.figures.add(block);
}

bool any_marked(const ContactLists& lists) {
  return std::find(lists.largest.begin(), lists.largest.end(), 1.0) != lists.largest.end();
}

void join_crowded(std::size_t blocks, ContactLists& lists) {
  lists.crowded.clear();
  for (std::size_t b = 0; b < blocks; ++b) {
    lists.crowded.insert(lists.crowded.end(), lists.crowded_blocks[b].begin(), lists.crowded_blocks[b].end());
  }
}

void collect_crowded(std::size_t blocks, const Executor& executor, ContactLists& lists, ImpactTally& tally) {
  join_crowded(blocks, lists);
  for (std::size_t b = 0; b < blocks; ++b) tally.add(lists.tallies[b]);
  executor.sort(lists.crowded.begin(), lists.crowded.end(), event_order);
}

void place_crowded(const Disks& disks, const Executor& executor, ContactLists& lists) {
  lists.placed.clear();
  if (executor.threads() == 1) return take_as_one_patch(lists.patches, lists.crowded.size());
  build_patches(lists.patches, disks, lists.contacts, lists.crowded.size(), executor,
                [&](std::size_t k) { return disks_of(lists.crowded[k]); });
  place_in_patches(executor, lists);
}

void place_in_patches(const Executor& executor, ContactLists& lists) {
  const std::vector<ContactEvent>& crowded = lists.crowded;
  resize_amply(lists.placed, crowded.size());
  executor.for_ranges(crowded.size(), contact_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; ++at) lists.placed[at] = crowded[lists.patches.order[at]];
  });
}

void gather_events(Disks& disks, const StepRules& rules, const FoundContacts& found, const Executor& executor,
                   ContactLists& lists) {
  lists.contacts.resize(disks.size(), 0);
  std::size_t place = found.find_offsets(lists.offsets);
  lists.events.resize(place + found.wall_contacts());
  with_view(disks, rules, [&](const auto& d) {
    executor.run_alike(found.used, [&](std::size_t b) {
      std::size_t at = lists.offsets[b];
      for (const Pair& found_pair : found.buffers[b]) {
        const Pair p = in_id_order(d.id, found_pair);
        lists.events[at++] = pair_event(d, rules, p.i1, p.i2);
      }
    });
  });
  for (const auto& buffer : found.walls) {
    for (const ContactEvent& e : buffer) lists.events[place++] = e;
  }
  count_contacts(lists, executor);
}

void count_contacts(ContactLists& lists, const Executor& executor) {
  executor.for_ranges(lists.events.size(), contact_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) count_event(lists.contacts, lists.events[k]);
  });
}

void clear_contact_counts(ContactLists& lists) {
  for (const ContactEvent& e : lists.events) {
    lists.contacts[e.i1] = 0;
    if (!is_wall(e.id2)) lists.contacts[e.i2] = 0;
  }
}

double resolve_contacts(State& state, const StepRules& rules, const FoundContacts& found, const Executor& executor,
                        ContactLists& lists) {
  ImpactTally tally;
  lists.figures = {};
  double speed2 = 0.0;
  if (rules.settles) {
    speed2 = settle_contacts(state, rules, found, executor, lists, tally);
  } else {
    with_view(state.disks, rules, [&](const auto& d) {
      speed2 = resolve_alone(d, rules, found, state.disks.size(), executor, lists, tally);
      resolve_crowded(d, rules, state.disks, executor, lists, tally, SingleRank{});
      speed2 = std::max(speed2, finish_crowded(d, rules.box, executor, lists));
    });
  }
  lists.figures.inaccurate += tally.inaccurate;
  lists.figures.inaccurate_at_walls += tally.inaccurate_at_walls;
  tally.count_into(state.counters);
  return speed2;
}

double resolve_alone_contacts(Disks& disks, const StepRules& rules, const FoundContacts& found,
                              const Executor& executor, ContactLists& lists, ImpactTally& tally) {
  lists.figures = {};
  return with_view(disks, rules,
                   [&](const auto& d) { return resolve_alone(d, rules, found, disks.size(), executor, lists, tally); });
}

double finish_crowded_contacts(Disks& disks, const StepRules& rules, const Executor& executor, ContactLists& lists) {
  return with_view(disks, rules, [&](const auto& d) { return finish_crowded(d, rules.box, executor, lists); });
}

double finish_contacts(Disks& disks, const Domain& box, const Executor& executor,
                       const std::vector<ContactEvent>& events, ContactLists& lists) {
  if (box.shear.acts()) {
    return finish_each(events, executor, lists, [&](std::uint32_t i, std::size_t) { return speed2_of(disks, i); });
  }
  return finish_each(events, executor, lists, [&](std::uint32_t i, std::size_t) { return wrap_moved(disks, box, i); });
}

}  // namespace carom
