#include "parallel/stepping/settle_contacts.hpp"

#include <algorithm>
#include <cstddef>

#include "parallel/stepping/contact_count.hpp"
#include "parallel/stepping/finish_disk.hpp"
#include "parallel/stepping/resolve_contacts.hpp"
#include "parallel/stepping/support_sweeps.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

namespace {

// Disks a block of the pass that finishes them.
constexpr std::size_t finish_block = 8192;

// All contacts into settle.pairs.found, and how many each disk has.
void gather_pairs(const Disks& disks, const FoundPairs& found, const std::vector<std::vector<ContactEvent>>& walls,
                  const Executor& executor, ContactLists& lists) {
  lists.contacts.resize(disks.size(), 0);
  lists.offsets.clear();
  std::size_t total = 0;
  for (std::size_t b = 0; b < found.used; ++b) {
    lists.offsets.push_back(total);
    total += found.buffers[b].size();
  }
  std::vector<IdPair>& pairs = lists.settle.pairs.found;
  std::size_t place = total;
  for (const auto& buffer : walls) total += buffer.size();
  resize_amply(pairs, total);
  const bool shared = executor.threads() > 1;
  const auto count = [&](std::uint32_t i) {
    if (shared) {
      count_contact_shared(lists.contacts[i]);
    } else {
      count_contact(lists.contacts[i]);
    }
  };
  executor.run(found.used, [&](std::size_t b) {
    std::size_t at = lists.offsets[b];
    for (const Pair& found_pair : found.buffers[b]) {
      const Pair p = in_id_order(disks.id.data(), found_pair);
      pairs[at++] = {id_key(disks.id[p.i1], disks.id[p.i2]), p.i1, p.i2};
      count(p.i1);
      count(p.i2);
    }
  });
  for (const auto& buffer : walls) {
    for (const ContactEvent& e : buffer) {
      pairs[place++] = {id_key(e.id1, e.id2), e.i1, e.i1};
      count_contact(lists.contacts[e.i1]);
    }
  }
}

void reserve_crowded_blocks(std::size_t blocks, const Executor& executor, ContactLists& lists) {
  if (lists.crowded_blocks.size() >= blocks) return;
  while (lists.crowded_blocks.size() < blocks + blocks / 4) {
    lists.crowded_blocks.emplace_back();
    lists.crowded_blocks.back().reserve(executor.grain(contact_block));
  }
}

// What every pair bore in the step before: its and the loads' orders are the same. Contacts that may be impacts, all
// but the loaded and crowded, are collected in lists.crowded; false: none of them is one, before any disk has
// moved.
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
      if (rules.round == 0 && !is_wall(p.id2())) see_overlap_before(d, rules, p.i1, p.i2, lists.seen[b]);
      lists.crowded_blocks[b].push_back(timed_event(d, rules, p));
      if (!is_support(d, rules, p.event(), force > 0.0, crowded)) lists.largest[b] = 1.0;
    }
  });
  add_seen(lists);
  join_crowded(blocks, lists);
  return std::find(lists.largest.begin(), lists.largest.end(), 1.0) != lists.largest.end();
}

// Impacts in order of time. What is a support is asked when its turn comes: an impact before may have changed it. That
// it was loaded would count for the crowded only, and those are not here.
template <class View>
void resolve_impacts(const View& d, const Disks& disks, const StepRules& rules, const Executor& executor,
                     ContactLists& lists, ImpactTally& tally) {
  executor.sort(lists.crowded.begin(), lists.crowded.end(), event_order);
  place_crowded(disks, executor, lists);
  assign_amply(lists.tallies, lists.patches.count(), {});
  Count before = 0;
  for (int pass = 0; pass < most_impact_passes; ++pass) {
    run_crowded(executor, lists, [&](const ContactEvent& e, std::size_t q) {
      const bool crowded = !is_alone(lists, e);
      if ((pass > 0 && !crowded) || is_support(d, rules, e, false, crowded)) return;
      lists.tallies[q].add(e.id2, resolve_event(d, rules, e));
    });
    if (!any_impact_since(before, lists.tallies)) break;
  }
  for (const ImpactTally& t : lists.tallies) tally.add(t);
}

// Every contact once, then the deep ones among the crowded until there are none.
template <class View>
void push_contacts(const View& d, const StepRules& rules, const Executor& executor, ContactLists& lists) {
  const SettleLists& settle = lists.settle;
  for (int sweep = 0; sweep < push_sweeps(rules); ++sweep) {
    assign_amply(lists.largest, lists.patches.count(), 0.0);
    run_patches(lists.patches, false, executor, [&](std::size_t q) {
      for (std::size_t at = lists.patches.start[q]; at < lists.patches.start[q + 1]; ++at) {
        const IdPair& p = settle.placed[at];
        const bool loaded = settle.holding[at] != 0;
        if (push_in_sweep(d, rules, p.event(), sweep, is_crowded(lists, p), loaded)) lists.largest[q] = 1.0;
      }
    });
    if (!any_deep(lists)) break;
  }
  see_overlaps_left(d, rules.box, settle.placed.size(), executor, lists,
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

}  // namespace

double settle_contacts(State& state, const StepRules& rules, const FoundPairs& found,
                       const std::vector<std::vector<ContactEvent>>& walls, const Executor& executor,
                       ContactLists& lists, ImpactTally& tally) {
  gather_pairs(state.disks, found, walls, executor, lists);
  sort_by_ids(lists.settle.pairs, state.next_id, executor);
  return with_view(state.disks, rules, [&](const auto& d) {
    if (look_up_loads(d, state, rules, executor, lists)) {
      resolve_impacts(d, state.disks, rules, executor, lists, tally);
    }
    bear_loads(d, state, rules, executor, lists, tally);
    push_contacts(d, rules, executor, lists);
    return finish_disks(d, state.disks.size(), rules.box, executor, lists);
  });
}

}  // namespace carom
