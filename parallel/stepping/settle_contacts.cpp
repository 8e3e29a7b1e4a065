#include "parallel/stepping/settle_contacts.hpp"

#include <cstddef>

#include "parallel/stepping/contact_count.hpp"
#include "parallel/stepping/most_contacts.hpp"
#include "parallel/stepping/resolve_contacts.hpp"
#include "parallel/stepping/settle_phases.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

void gather_pairs(const Disks& disks, const FoundContacts& found, const Executor& executor, ContactLists& lists) {
  lists.contacts.resize(disks.size(), 0);
  std::vector<IdPair>& pairs = lists.settle.pairs.found;
  std::size_t place = found.find_offsets(lists.offsets);
  check_contacts(place + found.wall_contacts());
  resize_amply(pairs, place + found.wall_contacts());
  const bool shared = executor.threads() > 1;
  const auto count = [&](std::uint32_t i) {
    if (shared) {
      count_contact_shared(lists.contacts[i]);
    } else {
      count_contact(lists.contacts[i]);
    }
  };
  executor.run_alike(found.used, [&](std::size_t b) {
    std::size_t at = lists.offsets[b];
    for (const Pair& found_pair : found.buffers[b]) {
      const Pair p = in_id_order(disks.id.data(), found_pair);
      pairs[at++] = {id_key(disks.id[p.i1], disks.id[p.i2]), p.i1, p.i2};
      count(p.i1);
      count(p.i2);
    }
  });
  for (const auto& buffer : found.walls) {
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

double settle_contacts(State& state, const StepRules& rules, const FoundContacts& found, const Executor& executor,
                       ContactLists& lists, ImpactTally& tally) {
  SingleSlab single;
  return settle_with(state, rules, found, state.disks.size(), executor, lists, tally, single);
}

}  // namespace carom
