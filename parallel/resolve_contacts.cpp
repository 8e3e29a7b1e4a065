#include "parallel/resolve_contacts.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "parallel/bear_loads.hpp"

namespace carom {

namespace {

constexpr auto wall_of_event = [](const ContactEvent& e) { return is_wall(e.id2); };

// Counts are sums of ones: whichever thread adds first, they end the same.
void count_contact(std::vector<std::uint16_t>& contacts, const ContactEvent& e) {
  std::atomic_ref<std::uint16_t>(contacts[e.i1]).fetch_add(1, std::memory_order_relaxed);
  if (!is_wall(e.id2)) std::atomic_ref<std::uint16_t>(contacts[e.i2]).fetch_add(1, std::memory_order_relaxed);
}

// Impacts of the crowded contacts in order of time, then the sweeps of pushing in order of ids.
template <class View>
void resolve_crowded(const View& d, const StepRules& rules, std::size_t disks, const Executor& executor,
                     ContactLists& lists, ImpactTally& tally) {
  std::vector<ContactEvent>& crowded = lists.crowded;
  if (crowded.empty()) return;
  build_levels(lists.levels, crowded, disks, executor, wall_of_event);
  const std::size_t blocks = executor.blocks(crowded.size(), level_block);
  lists.tallies.assign(blocks, {});
  run_levels(lists.levels, crowded.size(), false, executor, [&](std::size_t k, std::size_t block) {
    lists.tallies[block].add(crowded[k].id2, resolve_event(d, rules, crowded[k]));
  });
  for (const ImpactTally& t : lists.tallies) tally.add(t);
  executor.sort(crowded.begin(), crowded.end(), [](const auto& a, const auto& b) { return by_ids(a, b); });
  build_levels(lists.levels, crowded, disks, executor, wall_of_event);
  for (int sweep = 0; sweep < most_push_sweeps; ++sweep) {
    lists.largest.assign(blocks, 0.0);
    run_levels(lists.levels, crowded.size(), false, executor, [&](std::size_t k, std::size_t block) {
      lists.largest[block] = std::max(lists.largest[block], push_apart(d, rules.box, crowded[k], 0.0));
    });
    if (*std::max_element(lists.largest.begin(), lists.largest.end()) <= shallow_overlap) break;
  }
}

}  // namespace

void gather_events(Disks& disks, const StepRules& rules, const FoundPairs& found,
                   const std::vector<std::vector<ContactEvent>>& walls, const Executor& executor, ContactLists& lists) {
  lists.contacts.resize(disks.size(), 0);
  std::size_t total = found.count();
  for (const auto& buffer : walls) total += buffer.size();
  lists.events.resize(total);
  lists.offsets.clear();
  std::size_t place = 0;
  for (std::size_t b = 0; b < found.used; ++b) {
    lists.offsets.push_back(place);
    place += found.buffers[b].size();
  }
  with_view(disks, [&](const auto& d) {
    executor.run(found.used, [&](std::size_t b) {
      std::size_t at = lists.offsets[b];
      for (const Pair& p : found.buffers[b]) {
        lists.events[at++] = pair_event(d, rules, p.i1, p.i2);
      }
    });
  });
  for (const auto& buffer : walls) {
    for (const ContactEvent& e : buffer) lists.events[place++] = e;
  }
  count_contacts(lists, executor);
}

void count_contacts(ContactLists& lists, const Executor& executor) {
  executor.for_ranges(lists.events.size(), contact_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) count_contact(lists.contacts, lists.events[k]);
  });
}

void clear_contact_counts(ContactLists& lists) {
  for (const ContactEvent& e : lists.events) {
    lists.contacts[e.i1] = 0;
    if (!is_wall(e.id2)) lists.contacts[e.i2] = 0;
  }
}

void resolve_contacts(State& state, const StepRules& rules, const Executor& executor, ContactLists& lists) {
  if (lists.events.empty()) {
    state.loads.clear();
    return;
  }
  ImpactTally tally;
  with_view(state.disks, [&](const auto& d) {
    if (rules.settles) {
      settle_contacts(d, state, rules, executor, lists, tally);
      return;
    }
    split_crowded(executor, lists, tally, [&](const ContactEvent& e, ImpactTally& block) {
      block.add(e.id2, resolve_event(d, rules, e));
      push_apart(d, rules.box, e, 0.0);
    });
    resolve_crowded(d, rules, state.disks.size(), executor, lists, tally);
  });
  tally.count_into(state.counters);
}

double finish_contacts(Disks& disks, const Domain& box, const Executor& executor, ContactLists& lists) {
  const std::size_t blocks = executor.blocks(lists.events.size(), contact_block);
  lists.largest.assign(blocks, 0.0);
  executor.for_ranges(lists.events.size(), contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    // Whoever takes the count away wraps the disk: once each, and the result does not depend on who.
    const auto finish = [&](std::uint32_t i) {
      if (std::atomic_ref<std::uint16_t>(lists.contacts[i]).exchange(0, std::memory_order_relaxed) == 0) return;
      if (box.periodic_x()) disks.x[i] = wrap(disks.x[i], box.width);
      if (box.periodic_y()) disks.y[i] = wrap(disks.y[i], box.height);
      const double v2 = disks.vx[i] * disks.vx[i] + disks.vy[i] * disks.vy[i];
      lists.largest[b] = std::max(lists.largest[b], v2);
    };
    for (std::size_t k = begin; k < end; ++k) {
      finish(lists.events[k].i1);
      if (!is_wall(lists.events[k].id2)) finish(lists.events[k].i2);
    }
  });
  double largest = 0.0;
  for (const double v2 : lists.largest) largest = std::max(largest, v2);
  return largest;
}

}  // namespace carom
