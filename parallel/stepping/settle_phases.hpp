// The phases of a step in a scene that settles: impacts, supports, pushing apart. Others: as in support_sweeps.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/physics/push_apart.hpp"
#include "core/physics/resting.hpp"
#include "core/reference/step_contacts.hpp"
#include "parallel/stepping/disk_values.hpp"
#include "parallel/stepping/finish_disk.hpp"
#include "parallel/stepping/resolve_contacts.hpp"
#include "parallel/stepping/support_sweeps.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

// Disks in a block of the pass that finishes them.
inline constexpr std::size_t finish_block = 8192;

// Fills settle.pairs.found with all contacts, and counts those of each disk.
void gather_pairs(const Disks& disks, const FoundContacts& found, const Executor& executor, ContactLists& lists);

// Reserves memory for the events of this number of blocks.
void reserve_crowded_blocks(std::size_t blocks, const Executor& executor, ContactLists& lists);

// Looks up the force of each pair in the step before (settle.borne); pairs and loads are both in order of ids. Contacts
// that may be impacts become events in lists.crowded: all but those that are both loaded and crowded. Returns whether
// any of them is an impact, not a support, at present.
template <class View>
bool look_up_loads(const View& d, const State& state, const StepRules& rules, const Executor& executor,
                   ContactLists& lists) {
  const std::vector<IdPair>& pairs = lists.settle.pairs.sorted;
  const std::size_t blocks = executor.blocks(pairs.size(), contact_block);
  reserve_crowded_blocks(blocks, executor, lists);
  resize_amply(lists.settle.borne, pairs.size());
  assign_amply(lists.largest, blocks, 0.0);
  assign_amply(lists.seen, blocks, {});
  executor.for_ranges(pairs.size(), contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    lists.crowded_blocks[b].clear();
    const auto key_of = [](const ContactLoad& load) { return id_key(load.id1, load.id2); };
    auto load = std::lower_bound(state.loads.begin(), state.loads.end(), pairs[begin].key,
                                 [&](const ContactLoad& l, std::uint64_t key) { return key_of(l) < key; });
    for (std::size_t k = begin; k < end; ++k) {
      const IdPair& p = pairs[k];
      while (load != state.loads.end() && key_of(*load) < p.key) ++load;
      const double force = load != state.loads.end() && key_of(*load) == p.key ? load->force : 0.0;
      lists.settle.borne[k] = force;
      const bool crowded = is_crowded(lists, p);
      if (force > 0.0 && crowded) continue;
      if (rules.round == 0 && !is_wall(p.id2())) note_overlap_before(d, rules, p.i1, p.i2, lists.seen[b]);
      lists.crowded_blocks[b].push_back(timed_event(d, rules, p));
      if (!is_support(d, rules, p.event(), {.loaded = force > 0.0, .crowded = crowded})) lists.largest[b] = 1.0;
    }
  });
  add_seen(lists);
  join_crowded(blocks, lists);
  return any_marked(lists);
}

// Resolves impacts in order of time, and again if an impact of a crowded contact may have made others; contacts that
// are alone change no others. Whether a contact is a support is decided when its turn comes, since an impact before may
// have changed that. It counts as not loaded: a load matters for crowded contacts only, and loaded ones of those are
// not in the list.
template <class View, class Others>
void resolve_impacts(const View& d, Disks& disks, const StepRules& rules, const Executor& executor, ContactLists& lists,
                     ImpactTally& tally, Others& others) {
  executor.sort(lists.crowded.begin(), lists.crowded.end(), event_order);
  place_crowded(disks, executor, lists, others);
  assign_amply(lists.tallies, lists.patches.count(), {});
  for (int pass = 0; pass < most_impact_passes; ++pass) {
    assign_amply(lists.largest, lists.patches.count(), 0.0);
    const auto resolve_one = [&](const ContactEvent& e, std::size_t q) {
      const bool crowded = !is_alone(lists, e);
      if ((pass > 0 && !crowded) || is_support(d, rules, e, {.loaded = false, .crowded = crowded})) return;
      const Impact impact = resolve_event(d, rules, e);
      lists.tallies[q].add(e.id2, impact);
      if (crowded && has_happened(impact)) lists.largest[q] = 1.0;
    };
    run_crowded(executor, lists, resolve_one, others.before(Motions{disks}));
    if (!others.any(any_marked(lists))) break;
  }
  add_tallies(lists, others, tally);
  others.refresh(Motions{disks});
}

// Pushes every contact once, then the deep ones among the crowded until there are none.
template <class View, class Others>
void push_contacts(const View& d, Disks& disks, const StepRules& rules, const Executor& executor, ContactLists& lists,
                   Others& others) {
  const SettleLists& settle = lists.settle;
  for (int sweep = 0; sweep < push_sweeps(rules); ++sweep) {
    assign_amply(lists.largest, lists.patches.count(), 0.0);
    const auto push_patch = [&](std::size_t q) {
      for (std::size_t at = lists.patches.start[q]; at < lists.patches.start[q + 1]; ++at) {
        const IdPair& p = settle.placed[at];
        const ContactStatus status{.loaded = settle.holding[at] != 0, .crowded = is_crowded(lists, p)};
        if (push_in_sweep(d, rules, p.event(), sweep, status)) lists.largest[q] = 1.0;
      }
    };
    run_patches(lists.patches, false, executor, push_patch, others.before(Places{disks}));
    if (!others.any(any_marked(lists))) break;
  }
  others.refresh(Places{disks});
  note_overlaps_left(d, rules.box, settle.placed.size(), executor, lists,
                     [&](std::size_t k) { return settle.placed[k].event(); });
}

// Finishes the disks that had contacts, clears their counts, and returns the largest squared speed among them.
template <class View>
double finish_disks(const View& d, std::size_t n, const Domain& box, const Executor& executor, ContactLists& lists) {
  const WallReach walls(box);
  const std::size_t blocks = executor.blocks(n, finish_block);
  assign_amply(lists.largest, blocks, 0.0);
  assign_amply(lists.seen, blocks, {});
  executor.for_ranges(n, finish_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    double largest = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      if (lists.contacts[i] == 0) continue;
      lists.contacts[i] = 0;
      largest = std::max(largest, finish_disk(d, box, walls, static_cast<std::uint32_t>(i), lists.seen[b]));
    }
    lists.largest[b] = largest;
  });
  add_seen(lists);
  return lists.largest.empty() ? 0.0 : *std::max_element(lists.largest.begin(), lists.largest.end());
}

// settle_contacts, but only the first `own` disks are finished: the others belong to other ranks.
template <class Others>
double settle_with(State& state, const StepRules& rules, const FoundContacts& found, std::size_t own,
                   const Executor& executor, ContactLists& lists, ImpactTally& tally, Others& others) {
  gather_pairs(state.disks, found, executor, lists);
  sort_by_ids(lists.settle.pairs, state.next_id, executor);
  others.complete_counts(lists);
  return with_view(state.disks, rules, [&](const auto& d) {
    if (others.any(look_up_loads(d, state, rules, executor, lists))) {
      resolve_impacts(d, state.disks, rules, executor, lists, tally, others);
    }
    bear_loads(d, state, rules, executor, lists, tally, others);
    push_contacts(d, state.disks, rules, executor, lists, others);
    return finish_disks(d, own, rules.box, executor, lists);
  });
}

}  // namespace carom
