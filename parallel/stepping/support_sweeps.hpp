// The supports of a step, solved patch by patch with the bits of core/reference/step_contacts.cpp's serial sweeps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/physics/resting.hpp"
#include "core/physics/support_solver.hpp"
#include "parallel/stepping/resolve_contacts.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

inline bool is_crowded(const ContactLists& lists, const IdPair& p) {
  return lists.contacts[p.i1] > 1 || lists.contacts[p.i2] > 1;
}

// The step's pairs (settle.pairs.sorted) into the order of patches, and the supports among them.
template <class View>
void make_supports(const View& d, const Disks& disks, const StepRules& rules, const Executor& executor,
                   ContactLists& lists) {
  SettleLists& settle = lists.settle;
  const std::vector<IdPair>& pairs = settle.pairs.sorted;
  Patches& patches = lists.patches;
  build_patches(patches, disks, lists.contacts, pairs.size(), executor, [&](std::size_t k) {
    return Pair{pairs[k].i1, pairs[k].i2};
  });
  resize_amply(settle.placed, pairs.size());
  resize_amply(settle.holding, pairs.size());
  resize_amply(settle.supports, pairs.size());
  resize_amply(settle.place, pairs.size());
  resize_amply(settle.bearing, patches.count());
  resize_amply(settle.totals, patches.count());  // here, as few steps need them: a warm one allocates nothing
  executor.run(patches.count(), [&](std::size_t q) {
    std::uint32_t s = patches.start[q];
    for (std::uint32_t at = s; at < patches.start[q + 1]; ++at) {
      const IdPair p = pairs[patches.order[at]];
      double& borne = settle.borne[patches.order[at]];
      settle.placed[at] = p;
      settle.holding[at] = 0;
      if (is_solved(d, rules, p.event(), borne > 0.0, is_crowded(lists, p))) {
        settle.supports[s] = make_support(d, rules, p.event(), borne);
        settle.place[s++] = at;
      }
      borne = 0.0;
    }
    settle.bearing[q] = s - patches.start[q];
  });
}

// The sweeps that solve_supports (core/physics/support_solver.hpp) asks for.
template <class View>
struct PatchSweeps {
  const View& d;
  const Executor& executor;
  ContactLists& lists;

  // visit(support, patch) for all supports in order, or backwards.
  template <class Visit>
  void sweep(bool backwards, Visit&& visit) const {
    run_patches(lists.patches, backwards, executor, [&](std::size_t q) {
      Support* const first = lists.settle.supports.data() + lists.patches.start[q];
      const std::size_t count = lists.settle.bearing[q];
      for (std::size_t k = 0; k < count; ++k) visit(first[backwards ? count - 1 - k : k], q);
    });
  }

  // Sums over the patches are exact, so their order does not matter.
  CycleFigures cycle() const {
    std::vector<CycleFigures>& patch = lists.settle.figures;
    assign_amply(patch, lists.patches.count(), CycleFigures{});
    sweep(false, [&](Support& s, std::size_t q) { relax_forward(d, s, patch[q]); });
    sweep(true, [&](Support& s, std::size_t q) { relax_back(d, s, patch[q]); });
    CycleFigures all;
    for (const CycleFigures& f : patch) {
      all.largest = std::max(all.largest, f.largest);
      all.strain = std::max(all.strain, f.strain);
      all.square.add(f.square);
    }
    return all;
  }

  SupportTotals totals() const {
    std::vector<SupportTotals>& patch = lists.settle.totals;
    assign_amply(patch, lists.patches.count(), SupportTotals{});
    sweep(false, [&](const Support& s, std::size_t q) { patch[q].add(s); });
    SupportTotals all;
    for (const SupportTotals& t : patch) all.add(t);
    return all;
  }

  void extrapolate(double beta) const {
    sweep(false, [&](Support& s, std::size_t) { carom::extrapolate(d, s, beta); });
  }
};

// What the loads do to the disks, and their impulses back to the pairs (settle.borne, settle.holding).
template <class View>
void take_up_loads(const View& d, const StepRules& rules, const Executor& executor, ContactLists& lists,
                   ImpactTally& tally) {
  SettleLists& settle = lists.settle;
  const Patches& patches = lists.patches;
  assign_amply(lists.tallies, patches.count(), {});
  run_patches(patches, false, executor, [&](std::size_t q) {
    for (std::size_t k = patches.start[q]; k < patches.start[q] + settle.bearing[q]; ++k) {
      const Support& s = settle.supports[k];
      if (rules.round == 0) shift_by_load(d, s, rules.dt);
      lists.tallies[q].add_load(settle.placed[settle.place[k]].id2(), s, rules.box);
      settle.borne[patches.order[settle.place[k]]] = s.impulse;
      settle.holding[settle.place[k]] = s.impulse > 0.0 ? 1 : 0;
    }
  });
  for (const ImpactTally& t : lists.tallies) tally.add(t);
}

// The loads of the step in order of ids, from settle.borne.
void keep_loads(State& state, const StepRules& rules, const Executor& executor, ContactLists& lists);

// Solves the supports among the step's pairs; their loads go to state.loads, their impulses to the tally.
// Precondition: settle.borne has what each pair bore in the step, or the round, before.
template <class View>
void bear_loads(const View& d, State& state, const StepRules& rules, const Executor& executor, ContactLists& lists,
                ImpactTally& tally) {
  make_supports(d, state.disks, rules, executor, lists);
  const PatchSweeps<View> sweeps{d, executor, lists};
  if (rules.round == 0) {
    sweeps.sweep(false, [&](Support& s, std::size_t) { apply_impulse(d, s, s.impulse); });
  }
  solve_supports(rules, sweeps);
  take_up_loads(d, rules, executor, lists, tally);
  keep_loads(state, rules, executor, lists);
}

}  // namespace carom
