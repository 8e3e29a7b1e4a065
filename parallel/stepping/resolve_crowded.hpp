// Resolves the crowded contacts of a step in scenes in which nothing settles: impacts in order of time, then the sweeps
// of pushing in order of ids.
#pragma once

#include "core/physics/impact_tally.hpp"
#include "core/physics/push_apart.hpp"
#include "core/physics/resolve.hpp"
#include "parallel/stepping/resolve_contacts.hpp"

namespace carom {

// The cooperation with other ranks while contacts are resolved. SingleRank is for one rank with the whole box;
// OtherRanks (parallel/slabs/slab_stepping.cpp) for several ranks with slabs of it. any(here): is `here` true on any
// rank? (The number of passes depends on all contacts of the step.) counts(e): does this rank count the impact? Of two
// ranks that resolve a contact, one does.
struct SingleRank {
  static constexpr bool alone = true;
  bool any(bool here) const { return here; }
  bool counts(const ContactEvent& /*e*/) const { return true; }
};

// Precondition: lists.crowded is in canonical order of time; afterwards it is in order of ids.
template <class View, class Others>
void resolve_crowded(const View& d, const StepRules& rules, const Disks& disks, const Executor& executor,
                     ContactLists& lists, ImpactTally& tally, Others&& others) {
  if (others.alone && lists.crowded.empty()) return;
  place_crowded(disks, executor, lists);
  assign_amply(lists.tallies, lists.patches.count(), {});
  for (int pass = 0; pass < most_impact_passes; ++pass) {
    assign_amply(lists.largest, lists.patches.count(), 0.0);
    run_crowded(executor, lists, [&](const ContactEvent& e, std::size_t q) {
      const Impact impact = resolve_event(d, rules, e);
      if (others.counts(e)) lists.tallies[q].add(e.id2, impact);
      if (has_happened(impact)) lists.largest[q] = 1.0;
    });
    if (!others.any(any_marked(lists))) break;
  }
  for (const ImpactTally& t : lists.tallies) tally.add(t);
  executor.sort(lists.crowded.begin(), lists.crowded.end(), ids_order);
  place_crowded(disks, executor, lists);
  run_crowded(executor, lists, [&](const ContactEvent& e, std::size_t) { push_apart(d, rules.box, e, 0.0); });
  for (int sweep = 1; sweep < most_push_sweeps; ++sweep) {
    assign_amply(lists.largest, lists.patches.count(), 0.0);
    run_crowded(executor, lists, [&](const ContactEvent& e, std::size_t q) {
      if (!is_deep(d, rules.box, e, shallow_overlap)) return;
      push_apart(d, rules.box, e, 0.0);
      lists.largest[q] = 1.0;
    });
    if (!others.any(any_marked(lists))) break;
  }
  note_overlaps_left(d, rules.box, lists.crowded.size(), executor, lists,
                     [&](std::size_t k) { return lists.crowded[k]; });
}

}  // namespace carom
