// The supports of a step, solved patch by patch with the bits of core/reference/step_contacts.cpp's serial sweeps.
// Others: what ranks ask each other on the way; SingleSlab below, or OtherSlabs (parallel/slabs/other_slabs.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/physics/resting.hpp"
#include "core/physics/support_solver.hpp"
#include "parallel/stepping/disk_values.hpp"
#include "parallel/stepping/resolve_contacts.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

inline bool is_crowded(const ContactLists& lists, const IdPair& p) {
  return lists.contacts[p.i1] > 1 || lists.contacts[p.i2] > 1;
}

// What resolving a pile asks of other ranks. This one answers where one rank has the whole box. any(here): is it so on
// any rank? counts(patch): does this rank count the contacts of the patch? Of two ranks that resolve a contact, one
// does. before(values): what run_patches calls before each phase; values are those that the sweep changes.
// refresh(values): brings the values of other ranks' disks up to date.
struct SingleSlab {
  static constexpr bool alone = true;
  bool any(bool here) const { return here; }
  bool counts(std::size_t /*patch*/) const { return true; }
  void complete_counts(ContactLists& /*lists*/) const {}
  void add_up(CycleFigures& /*figures*/, Watch /*watch*/) const {}
  void add_up(SupportTotals& /*totals*/) const {}
  template <class DisksOf>
  void build(Patches& patches, const Disks& disks, const std::vector<std::uint16_t>& in_contact, std::size_t contacts,
             const Executor& executor, DisksOf&& disks_of) const {
    build_patches(patches, disks, in_contact, contacts, executor, disks_of);
  }
  template <class Values>
  auto before(Values /*values*/) const {
    return [](std::uint32_t /*phase*/, bool /*backwards*/) {};
  }
  template <class Values>
  void refresh(Values /*values*/) const {}
};

// Room for so many supports.
void resize_supports(SupportSet& set, std::size_t supports, std::size_t disks);

// Adds the tallies of the patches that this rank counts.
template <class Others>
void add_tallies(const ContactLists& lists, const Others& others, ImpactTally& tally) {
  for (std::size_t q = 0; q < lists.tallies.size(); ++q) {
    if (others.counts(q)) tally.add(lists.tallies[q]);
  }
}

// The step's pairs (settle.pairs.sorted) into the order of patches, and the supports among them.
template <class View, class Others>
void make_supports(const View& d, const Disks& disks, const StepRules& rules, const Executor& executor,
                   ContactLists& lists, Others&& others) {
  SettleLists& settle = lists.settle;
  const std::vector<IdPair>& pairs = settle.pairs.sorted;
  Patches& patches = lists.patches;
  others.build(patches, disks, lists.contacts, pairs.size(), executor, [&](std::size_t k) {
    return Pair{pairs[k].i1, pairs[k].i2};
  });
  resize_amply(settle.placed, pairs.size());
  resize_amply(settle.holding, pairs.size());
  resize_supports(settle.supports, pairs.size(), disks.size());
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
        set_support(settle.supports, s, d, rules, p.event(), borne);
        settle.place[s++] = at;
      }
      borne = 0.0;
    }
    settle.bearing[q] = s - patches.start[q];
  });
}

// Disks a block of the passes over velocities.
inline constexpr std::size_t velocity_block = 4096;

// visit(i) for all disks in contact.
template <class Visit>
void visit_in_contact(const ContactLists& lists, const Executor& executor, Visit&& visit) {
  executor.for_ranges(lists.contacts.size(), velocity_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (lists.contacts[i] != 0) visit(i);
    }
  });
}

// The sweeps that solve_supports (core/physics/support_solver.hpp) asks for.
template <class Others>
struct PatchSweeps {
  const Executor& executor;
  ContactLists& lists;
  Others& others;

  // visit(support, patch) for all supports in order, or backwards. before: as in run_patches.
  template <bool backwards, class Visit, class Before>
  void sweep(Visit&& visit, Before&& before) const {
    const auto run_patch = [&](std::size_t q) {
      const std::size_t first = lists.patches.start[q];
      const std::size_t end = first + lists.settle.bearing[q];
      if constexpr (backwards) {
        for (std::size_t k = end; k > first; --k) visit(k - 1, q);
      } else {
        for (std::size_t k = first; k < end; ++k) visit(k, q);
      }
    };
    run_patches(lists.patches, backwards, executor, run_patch, before);
  }
  // For visits that read nothing of a contact's other disk that another visit may have changed: other ranks need not be
  // asked.
  template <class Visit>
  void visit_all(Visit&& visit) const {
    sweep<false>(visit, [](std::uint32_t /*phase*/, bool /*backwards*/) {});
  }

  // Sums over the patches are exact, so their order does not matter.
  template <Watch watch>
  CycleFigures cycle() const {
    SupportSet& set = lists.settle.supports;
    std::vector<CycleFigures>& patch = lists.settle.figures;
    if (watch != Watch::nothing) assign_amply(patch, lists.patches.count(), CycleFigures{});
    const auto before = others.before(Velocities{set.v.data()});
    sweep<false>([&](std::size_t k, std::size_t q) { relax_forward<watch>(set, k, patch[q]); }, before);
    sweep<true>([&](std::size_t k, std::size_t q) { relax_back<watch>(set, k, patch[q]); }, before);
    if constexpr (watch == Watch::all) {
      executor.run(patch.size(), [&](std::size_t q) {
        const std::size_t first = lists.patches.start[q];
        add_products(set, first, first + lists.settle.bearing[q], patch[q]);
      });
    }
    CycleFigures all;
    if (watch == Watch::nothing) return all;
    for (std::size_t q = 0; q < patch.size(); ++q) {
      if (others.counts(q)) all.add(patch[q]);
    }
    others.add_up(all, watch);
    return all;
  }

  SupportTotals totals() const {
    std::vector<SupportTotals>& patch = lists.settle.totals;
    const SupportSet& set = lists.settle.supports;
    assign_amply(patch, lists.patches.count(), SupportTotals{});
    visit_all([&](std::size_t k, std::size_t q) { patch[q].add(set.impulse[k], set.contact[k].effective); });
    SupportTotals all;
    for (std::size_t q = 0; q < patch.size(); ++q) {
      if (others.counts(q)) all.add(patch[q]);
    }
    others.add_up(all);
    return all;
  }

  void extrapolate(double momentum) const {
    SupportSet& set = lists.settle.supports;
    executor.run(lists.patches.count(), [&](std::size_t q) {
      const std::size_t first = lists.patches.start[q];
      extrapolate_impulses(set, first, first + lists.settle.bearing[q], momentum);
    });
    visit_in_contact(lists, executor, [v = set.v.data(), last = set.last_v.data(), momentum](std::size_t i) {
      extrapolate_velocity(v[i], last[i], momentum);
    });
  }
};

// What the loads do to the disks, and their impulses back to the pairs (settle.borne, settle.holding).
template <class View, class Others>
void take_up_loads(const View& d, const StepRules& rules, const Executor& executor, ContactLists& lists,
                   ImpactTally& tally, Others&& others) {
  SettleLists& settle = lists.settle;
  const Patches& patches = lists.patches;
  assign_amply(lists.tallies, patches.count(), {});
  run_patches(patches, false, executor, [&](std::size_t q) {
    for (std::size_t k = patches.start[q]; k < patches.start[q] + settle.bearing[q]; ++k) {
      const double impulse = settle.supports.impulse[k];
      if (rules.round == 0) shift_by_load(d, settle.supports.contact[k], impulse, rules.dt);
      lists.tallies[q].add_load(settle.placed[settle.place[k]].id2(), settle.supports, k, rules.box);
      settle.borne[patches.order[settle.place[k]]] = impulse;
      settle.holding[settle.place[k]] = impulse > 0.0 ? 1 : 0;
    }
  });
  add_tallies(lists, others, tally);
}

// The loads of the step in order of ids, from settle.borne.
void keep_loads(State& state, const StepRules& rules, const Executor& executor, ContactLists& lists);

// Solves the supports among the step's pairs; their loads go to state.loads, their impulses to the tally.
// Precondition: settle.borne has what each pair bore in the step, or the round, before.
template <class View, class Others>
void bear_loads(const View& d, State& state, const StepRules& rules, const Executor& executor, ContactLists& lists,
                ImpactTally& tally, Others& others) {
  make_supports(d, state.disks, rules, executor, lists, others);
  SupportSet& set = lists.settle.supports;
  visit_in_contact(lists, executor, [&](std::size_t i) { set.v[i] = {d.vx[i], d.vy[i]}; });
  const PatchSweeps<Others> sweeps{executor, lists, others};
  if (rules.round == 0) {
    sweeps.visit_all([&](std::size_t k, std::size_t) { apply_impulse(set.v.data(), set.contact[k], set.impulse[k]); });
  }
  solve_supports(rules, sweeps);
  visit_in_contact(lists, executor, [&](std::size_t i) {
    d.vx[i] = set.v[i].x;
    d.vy[i] = set.v[i].y;
  });
  take_up_loads(d, rules, executor, lists, tally, others);
  keep_loads(state, rules, executor, lists);
}

}  // namespace carom
