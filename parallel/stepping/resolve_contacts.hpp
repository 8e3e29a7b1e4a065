// Resolves the contacts of a step on many threads, with the bits of core/reference/step_contacts.cpp. Most contacts of
// a gas are alone: neither disk has another one. They commute with all others and are resolved in place. The others,
// the crowded ones, are resolved in canonical order, by patches if there are many.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/physics/resolve.hpp"
#include "core/reference/step_contacts.hpp"
#include "core/step/validity.hpp"
#include "parallel/stepping/find_contacts.hpp"
#include "parallel/stepping/patches.hpp"
#include "parallel/stepping/settle_contacts.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

// Lists that are filled in each step; kept, so that a warm step allocates nothing.
struct ContactLists {
  std::vector<ContactEvent> events;     // all events of the step, in storage order
  std::vector<std::uint16_t> contacts;  // of each disk (contact_count.hpp); all 0 between steps
  std::vector<ContactEvent> crowded;
  std::vector<std::vector<ContactEvent>> crowded_blocks;
  // The crowded events in the order of the patches. Empty if lists.crowded has that order already.
  std::vector<ContactEvent> placed;
  std::vector<ImpactTally> tallies;  // of each block
  std::vector<double> largest;       // of each block
  std::vector<std::size_t> offsets;  // of each block's part of a list
  Patches patches;
  SettleLists settle;
  std::vector<StepFigures> seen;  // of each block
  StepFigures figures;            // of the last resolve
};

// Collects the events of the pairs found and of the wall contacts in one list, and counts the contacts of each disk.
void gather_events(Disks& disks, const StepRules& rules, const FoundContacts& found, const Executor& executor,
                   ContactLists& lists);

// Resolves and pushes apart all pairs found and wall contacts, wraps the disks that had contacts, and returns the
// largest squared speed among those. The bits are those of resolve_serially (core/reference/step_contacts.hpp).
double resolve_contacts(State& state, const StepRules& rules, const FoundContacts& found, const Executor& executor,
                        ContactLists& lists);

// The first part of resolve_contacts, for scenes in which nothing settles: resolves the contacts that are alone, and
// leaves the others in lists.crowded, in canonical order of time. resolve_crowded.hpp has the second part,
// finish_contacts is the last. Returns the largest squared speed of the disks that it has finished.
double resolve_alone_contacts(Disks& disks, const StepRules& rules, const FoundContacts& found,
                              const Executor& executor, ContactLists& lists, ImpactTally& tally);
double finish_crowded_contacts(Disks& disks, const StepRules& rules, const Executor& executor, ContactLists& lists);

// Wraps the disks in events, clears their counts, returns the largest squared speed among them.
double finish_contacts(Disks& disks, const Domain& box, const Executor& executor,
                       const std::vector<ContactEvent>& events, ContactLists& lists);

// Sets the contact counts of the disks in lists.events (contact_count.hpp).
void count_contacts(ContactLists& lists, const Executor& executor);
void clear_contact_counts(ContactLists& lists);

// Keeps the events for which keep(event) holds, and counts the contacts of each disk anew.
template <class Keep>
void keep_events(ContactLists& lists, const Executor& executor, Keep&& keep) {
  clear_contact_counts(lists);
  std::erase_if(lists.events, [&](const ContactEvent& e) { return !keep(e); });
  count_contacts(lists, executor);
}

// Is the contact alone, so that it commutes with all others?
inline bool is_alone(const ContactLists& lists, const ContactEvent& e) {
  return lists.contacts[e.i1] == 1 && (is_wall(e.id2) || lists.contacts[e.i2] == 1);
}

// Moves the events that are not alone to lists.crowded, in canonical order of time, and calls alone(event, tally) for
// the others, in parallel. Adds the tallies to `tally`.
template <class Alone>
void split_crowded(const Executor& executor, ContactLists& lists, ImpactTally& tally, Alone&& alone);

// Joins the blocks' crowded events in lists.crowded, in canonical order of time, and adds their tallies.
void collect_crowded(std::size_t blocks, const Executor& executor, ContactLists& lists, ImpactTally& tally);

// Joins the blocks' crowded events in lists.crowded, in the order of the blocks.
void join_crowded(std::size_t blocks, ContactLists& lists);

// Distributes lists.crowded to patches, in its order, into lists.placed. With one thread nothing is moved: these
// contacts are visited two to five times, too few to pay for it.
void place_crowded(const Disks& disks, const Executor& executor, ContactLists& lists);

// The same on several ranks, where patches also have to wait for contacts of other ranks (Others: support_sweeps.hpp).
template <class Others>
void place_crowded(const Disks& disks, const Executor& executor, ContactLists& lists, Others& others);

// Copies lists.crowded to lists.placed in the order of the patches.
void place_in_patches(const Executor& executor, ContactLists& lists);

inline Pair disks_of(const ContactEvent& e) {
  return {e.i1, is_wall(e.id2) ? e.i1 : e.i2};
}

// Calls task(contact, patch) for all of lists.crowded, in the order that it had at place_crowded. before: as in
// run_patches.
template <class Task, class Before>
void run_crowded(const Executor& executor, const ContactLists& lists, Task&& task, Before&& before) {
  const std::vector<ContactEvent>& list = lists.placed.empty() ? lists.crowded : lists.placed;
  const auto run_patch = [&](std::size_t q) {
    for (std::size_t at = lists.patches.start[q]; at < lists.patches.start[q + 1]; ++at) task(list[at], q);
  };
  run_patches(lists.patches, false, executor, run_patch, before);
}
template <class Task>
void run_crowded(const Executor& executor, const ContactLists& lists, Task&& task) {
  run_crowded(executor, lists, task, [](std::uint32_t /*phase*/, bool /*backwards*/) {});
}

// Is another sweep or pass needed? A sweep sets lists.largest of a patch to 1 if it pushed a deep contact there, a pass
// if an impact there may have made others.
bool any_marked(const ContactLists& lists);

// Enters the deepest overlap left to the contacts event(0) to event(n - 1) in lists.figures.
template <class View, class Event>
void note_overlaps_left(const View& d, const Domain& box, std::size_t n, const Executor& executor, ContactLists& lists,
                        Event&& event);

// Adds the figures of the blocks to lists.figures.
void add_seen(ContactLists& lists);

// Contacts in a block of parallel passes over them.
inline constexpr std::size_t contact_block = 1024;

template <class View, class Event>
void note_overlaps_left(const View& d, const Domain& box, std::size_t n, const Executor& executor, ContactLists& lists,
                        Event&& event) {
  assign_amply(lists.seen, executor.blocks(n, contact_block), {});
  executor.for_ranges(n, contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) note_overlap_left(d, box, event(k), lists.seen[b]);
  });
  add_seen(lists);
}

template <class Others>
void place_crowded(const Disks& disks, const Executor& executor, ContactLists& lists, Others& others) {
  if constexpr (Others::alone) {
    place_crowded(disks, executor, lists);
  } else {
    others.build(lists.patches, disks, lists.contacts, lists.crowded.size(), executor,
                 [&](std::size_t k) { return disks_of(lists.crowded[k]); });
    place_in_patches(executor, lists);
  }
}

template <class Alone>
void split_crowded(const Executor& executor, ContactLists& lists, ImpactTally& tally, Alone&& alone) {
  const std::size_t blocks = executor.blocks(lists.events.size(), contact_block);
  if (lists.crowded_blocks.size() < blocks) lists.crowded_blocks.resize(blocks);
  lists.tallies.assign(blocks, {});
  executor.for_ranges(lists.events.size(), contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    lists.crowded_blocks[b].clear();
    for (std::size_t k = begin; k < end; ++k) {
      const ContactEvent& e = lists.events[k];
      if (is_alone(lists, e)) {
        alone(e, lists.tallies[b]);
      } else {
        lists.crowded_blocks[b].push_back(e);
      }
    }
  });
  collect_crowded(blocks, executor, lists, tally);
}

}  // namespace carom
