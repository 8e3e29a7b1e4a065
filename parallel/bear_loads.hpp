// Scenes that settle: impacts, supports and pushing of core/step_contacts.cpp, level by level.
#pragma once

#include <algorithm>
#include <cstddef>

#include "parallel/resolve_contacts.hpp"

namespace carom {

// Keeps lists.events; works on lists.loaded, all contacts of the step with their loads.
template <class View>
void settle_contacts(const View& d, State& state, const StepRules& rules, const Executor& executor, ContactLists& lists,
                     ImpactTally& tally);

namespace settling {

inline constexpr auto wall_of_loaded = [](const LoadedContact& c) { return is_wall(c.event.id2); };
inline constexpr auto wall_of_support = [](const Support& s) { return s.inverse2 == 0.0; };

// All contacts with their loads of the step before, and whether any is an impact.
template <class View>
bool look_up_loads(const View& d, const State& state, const StepRules& rules, const Executor& executor,
                   ContactLists& lists) {
  lists.loaded.resize(lists.events.size());
  const std::size_t blocks = executor.blocks(lists.events.size(), contact_block);
  lists.largest.assign(blocks, 0.0);
  executor.for_ranges(lists.events.size(), contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const ContactEvent& e = lists.events[k];
      const LoadedContact c{e, e.i1, e.i2, load_of(state.loads, e), !is_alone(lists, e)};
      if (!is_support(d, rules, e, c.force > 0.0, c.crowded)) lists.largest[b] = 1.0;
      lists.loaded[k] = c;
    }
  });
  return std::find(lists.largest.begin(), lists.largest.end(), 1.0) != lists.largest.end();
}

// Impacts in order of time. What is a support is asked when its turn comes: an impact before may have changed it.
template <class View>
void resolve_impacts(const View& d, const StepRules& rules, std::size_t disks, const Executor& executor,
                     ContactLists& lists, ImpactTally& tally) {
  executor.sort(lists.loaded.begin(), lists.loaded.end(),
                [](const LoadedContact& a, const LoadedContact& b) { return earlier(a.event, b.event); });
  build_levels(lists.levels, lists.loaded, disks, executor, wall_of_loaded);
  lists.tallies.assign(static_cast<std::size_t>(executor.threads()), {});
  run_levels(lists.levels, lists.loaded.size(), false, executor, [&](std::size_t k, std::size_t slot) {
    const LoadedContact& c = lists.loaded[k];
    if (is_support(d, rules, c.event, c.force > 0.0, c.crowded)) return;
    lists.tallies[slot].add(c.event.id2, resolve_event(d, rules, c.event));
  });
  for (const ImpactTally& t : lists.tallies) tally.add(t);
}

// The supports among the contacts, in order of ids; bears[k] tells whether contact k is one.
template <class View>
void make_supports(const View& d, const StepRules& rules, const Executor& executor, ContactLists& lists) {
  const std::size_t n = lists.loaded.size();
  const std::size_t blocks = executor.blocks(n, contact_block);
  lists.offsets.assign(blocks + 1, 0);
  executor.for_ranges(n, contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t k = begin; k < end; ++k) {
      LoadedContact& c = lists.loaded[k];
      c.bears = is_support(d, rules, c.event, c.force > 0.0, c.crowded);
      count += c.bears ? 1 : 0;
    }
    lists.offsets[b + 1] = count;
  });
  for (std::size_t b = 0; b < blocks; ++b) lists.offsets[b + 1] += lists.offsets[b];
  lists.supports.resize(lists.offsets[blocks]);
  executor.for_ranges(n, contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::size_t at = lists.offsets[b];
    for (std::size_t k = begin; k < end; ++k) {
      LoadedContact& c = lists.loaded[k];
      if (!c.bears) continue;
      c.support = static_cast<std::uint32_t>(at);
      lists.supports[at++] = make_support(d, rules, c.event, c.force);
    }
  });
}

template <class View>
void relax_supports(const View& d, State& state, const StepRules& rules, const Executor& executor,
                    ContactLists& lists) {
  std::vector<Support>& supports = lists.supports;
  build_levels(lists.levels, supports, state.disks.size(), executor, wall_of_support);
  run_levels(lists.levels, supports.size(), false, executor,
             [&](std::size_t k, std::size_t) { apply_impulse(d, supports[k], supports[k].impulse); });
  const double settled = settled_change * rules.gravity * rules.dt;
  for (int sweep = 0; sweep < most_load_sweeps; ++sweep) {
    lists.largest.assign(static_cast<std::size_t>(executor.threads()), 0.0);
    run_levels(lists.levels, supports.size(), sweep % 2 == 1, executor, [&](std::size_t k, std::size_t slot) {
      lists.largest[slot] = std::max(lists.largest[slot], relax(d, supports[k]));
    });
    if (*std::max_element(lists.largest.begin(), lists.largest.end()) <= settled) break;
  }
  state.loads.clear();
  for (const Support& s : supports) {
    if (s.impulse > 0.0) state.loads.push_back({s.id1, s.id2, s.impulse / rules.dt});
  }
}

// Is a crowded contact deep now? Asked of all at once, before a sweep that goes through them in order: none deep at its
// beginning means none found deep in it.
template <class View>
bool any_deep(const View& d, const StepRules& rules, const Executor& executor, ContactLists& lists) {
  lists.largest.assign(executor.blocks(lists.loaded.size(), contact_block), 0.0);
  executor.for_ranges(lists.loaded.size(), contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      if (lists.loaded[k].crowded && is_deep(d, rules.box, lists.loaded[k].event)) lists.largest[b] = 1.0;
    }
  });
  return std::find(lists.largest.begin(), lists.largest.end(), 1.0) != lists.largest.end();
}

// Every contact once, then the deep ones among the crowded until there are none.
template <class View>
void push_contacts(const View& d, const StepRules& rules, std::size_t disks, const Executor& executor,
                   ContactLists& lists) {
  const std::vector<LoadedContact>& contacts = lists.loaded;
  const double slop = contact_slop * rules.gravity * rules.dt * rules.dt;
  const auto push = [&](const LoadedContact& c) {
    const bool loaded = c.bears && lists.supports[c.support].impulse > 0.0;
    push_apart(d, rules.box, c.event, loaded ? slop : 0.0);
  };
  build_levels(lists.levels, contacts, disks, executor, wall_of_loaded);
  run_levels(lists.levels, contacts.size(), false, executor, [&](std::size_t k, std::size_t) { push(contacts[k]); });
  for (int sweep = 1; sweep < most_push_sweeps; ++sweep) {
    if (!any_deep(d, rules, executor, lists)) break;
    run_levels(lists.levels, contacts.size(), false, executor, [&](std::size_t k, std::size_t) {
      if (contacts[k].crowded && is_deep(d, rules.box, contacts[k].event)) push(contacts[k]);
    });
  }
}

}  // namespace settling

template <class View>
void settle_contacts(const View& d, State& state, const StepRules& rules, const Executor& executor, ContactLists& lists,
                     ImpactTally& tally) {
  using namespace settling;
  const std::size_t disks = state.disks.size();
  if (look_up_loads(d, state, rules, executor, lists)) resolve_impacts(d, rules, disks, executor, lists, tally);
  executor.sort(lists.loaded.begin(), lists.loaded.end(),
                [](const LoadedContact& a, const LoadedContact& b) { return by_ids(a.event, b.event); });
  make_supports(d, rules, executor, lists);
  relax_supports(d, state, rules, executor, lists);
  push_contacts(d, rules, disks, executor, lists);
}

}  // namespace carom
