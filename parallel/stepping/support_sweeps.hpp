// Solves the supports of a step, by patches, with the bits of the serial sweeps of core/reference/step_contacts.cpp.
// Others: the cooperation with other ranks; SingleSlab below, or OtherSlabs (parallel/slabs/other_slabs.hpp).
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
#include "parallel/stepping/support_batches.hpp"
#include "parallel/stepping/sweep_kernel.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

inline bool is_crowded(const ContactLists& lists, const IdPair& p) {
  return lists.contacts[p.i1] > 1 || lists.contacts[p.i2] > 1;
}

// The cooperation with other ranks while a pile is resolved. SingleSlab is for one rank with the whole box. any(here):
// is `here` true on any rank? counts(patch): does this rank count the contacts of the patch? Of two ranks that resolve
// a contact, one does. before(values): the function that run_patches calls before each phase; values: those that the
// sweep changes. refresh(values): updates the values of other ranks' disks.
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

// Sets the columns of all slots to those of unused lanes, and puts the spare disks at rest.
void resize_supports(SupportSet& set, const SupportBatches& batches, std::size_t patches, std::size_t disks);

// Adds the tallies of the patches that this rank counts.
template <class Others>
void add_tallies(const ContactLists& lists, const Others& others, ImpactTally& tally) {
  for (std::size_t q = 0; q < lists.tallies.size(); ++q) {
    if (others.counts(q)) tally.add(lists.tallies[q]);
  }
}

// Puts the step's pairs (settle.pairs.sorted) into the order of patches, and finds the slots of the supports among
// them.
template <class View, class Others>
void place_supports(const View& d, const Disks& disks, const StepRules& rules, const Executor& executor,
                    ContactLists& lists, Others&& others) {
  SettleLists& settle = lists.settle;
  const std::vector<IdPair>& pairs = settle.pairs.sorted;
  Patches& patches = lists.patches;
  others.build(patches, disks, lists.contacts, pairs.size(), executor, [&](std::size_t k) {
    return Pair{pairs[k].i1, pairs[k].i2};
  });
  resize_amply(settle.placed, pairs.size());
  resize_amply(settle.holding, pairs.size());
  resize_amply(settle.totals,
               patches.count());  // allocated here, since few steps use them: a warm step allocates nothing
  begin_batches(settle.batches, patches, disks.size());
  run_patches(patches, false, executor, [&](std::size_t q) {
    for (std::uint32_t at = patches.start[q]; at < patches.start[q + 1]; ++at) {
      settle.placed[at] = pairs[patches.order[at]];
      settle.holding[at] = 0;
    }
    place_in_batches(
        settle.batches, patches, q,
        [&](std::size_t at) {
          return Pair{settle.placed[at].i1, settle.placed[at].i2};
        },
        [&](std::size_t at) {
          const IdPair& p = settle.placed[at];
          const double borne_before = settle.borne[patches.order[at]];
          return is_solved(d, rules, p.event(), {.loaded = borne_before > 0.0, .crowded = is_crowded(lists, p)});
        });
  });
  lay_out_batches(settle.batches);
}

// Calls visit(at, slot) for the supports of a patch in order; at: index in settle.placed.
template <class Visit>
void visit_supports(const ContactLists& lists, std::size_t patch, Visit&& visit) {
  const std::vector<std::uint32_t>& slot = lists.settle.batches.slot;
  for (std::size_t at = lists.patches.start[patch]; at < lists.patches.start[patch + 1]; ++at) {
    if (slot[at] != no_slot) visit(at, slot[at]);
  }
}

// Makes the supports of the step in batches, and sets settle.borne to 0.
template <class View, class Others>
void make_supports(const View& d, const Disks& disks, const StepRules& rules, const Executor& executor,
                   ContactLists& lists, Others&& others) {
  place_supports(d, disks, rules, executor, lists, others);
  SettleLists& settle = lists.settle;
  const Patches& patches = lists.patches;
  resize_supports(settle.supports, settle.batches, patches.count(), disks.size());
  executor.run(patches.count(), [&](std::size_t q) {
    clear_batches(settle.batches, patches, q, SupportBatches::spare(disks.size(), q));
    visit_supports(lists, q, [&](std::size_t at, std::uint32_t slot) {
      const ContactEvent e = settle.placed[at].event();
      put_support(settle.batches, slot, make_support(d, rules, e));
      begin_support(settle.supports, slot, d, rules, e, settle.borne[patches.order[at]]);
    });
    for (std::uint32_t at = patches.start[q]; at < patches.start[q + 1]; ++at) settle.borne[patches.order[at]] = 0.0;
  });
}

// Disks in a block of the passes over velocities.
inline constexpr std::size_t velocity_block = 4096;

// Calls visit(i) for all disks in contact.
template <class Visit>
void visit_in_contact(const ContactLists& lists, const Executor& executor, Visit&& visit) {
  executor.for_ranges(lists.contacts.size(), velocity_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (lists.contacts[i] != 0) visit(i);
    }
  });
}

// The Sweeps of solve_supports (core/physics/support_solver.hpp).
template <class Others>
struct PatchSweeps {
  const Executor& executor;
  ContactLists& lists;
  Others& others;
  SweepKernels kernels = choose_sweep_kernels();

  // Relaxes the batches of all patches, forward or back. before: as in run_patches.
  template <Watch watch, class Before>
  void relax_all(Sweep sweep, Before&& before) const {
    SettleLists& settle = lists.settle;
    const std::vector<std::uint32_t>& first = settle.batches.first;
    const SweepInput in = input();
    const auto run_patch = [&](std::size_t q) {
      CycleFigures* const figures = watch == Watch::nothing ? nullptr : &settle.figures[q];
      kernels.relax(in, sweep, watch, first[q], first[q + 1], figures);
    };
    run_patches(lists.patches, sweep == Sweep::back, executor, run_patch, before);
  }

  // Sums over the patches are exact, so their order does not matter.
  template <Watch watch>
  CycleFigures cycle() const {
    SupportSet& set = lists.settle.supports;
    std::vector<CycleFigures>& patch = lists.settle.figures;
    if (watch != Watch::nothing) assign_amply(patch, lists.patches.count(), CycleFigures{});
    const auto before = others.before(Velocities{set.v.data()});
    relax_all<watch>(Sweep::forward, before);
    relax_all<watch>(Sweep::back, before);
    if constexpr (watch == Watch::all) {
      executor.run(patch.size(), [&](std::size_t q) {
        const std::vector<std::uint32_t>& first = lists.settle.batches.first;
        add_products(set, batch_lanes * first[q], batch_lanes * first[q + 1], patch[q]);
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
    const SettleLists& settle = lists.settle;
    assign_amply(patch, lists.patches.count(), SupportTotals{});
    executor.run(patch.size(), [&](std::size_t q) {
      visit_supports(lists, q, [&](std::size_t, std::uint32_t slot) {
        patch[q].add(settle.supports.impulse[slot], support_in(settle.batches, slot).effective);
      });
    });
    SupportTotals all;
    for (std::size_t q = 0; q < patch.size(); ++q) {
      if (others.counts(q)) all.add(patch[q]);
    }
    others.add_up(all);
    return all;
  }

  void extrapolate(double momentum) const {
    const std::vector<std::uint32_t>& first = lists.settle.batches.first;
    const SweepInput in = input();
    executor.run(lists.patches.count(),
                 [&](std::size_t q) { kernels.extrapolate(in, first[q], first[q + 1], momentum); });
    executor.for_ranges(lists.contacts.size(), velocity_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      kernels.extrapolate_velocities(in, lists.contacts.data(), begin, end, momentum);
    });
  }

  SweepInput input() const {
    SettleLists& settle = lists.settle;
    SupportSet& set = settle.supports;
    const auto numbers = [](std::vector<Vec2>& vectors) { return vectors.empty() ? nullptr : &vectors.front().x; };
    return {settle.batches.batch.data(), set.impulse.data(), set.last.data(),    set.before.data(), set.ahead.data(),
            set.contact_distance.data(), numbers(set.v),     numbers(set.last_v)};
  }
};

// Displaces the disks by the loads, tallies these, and stores their forces with the pairs (settle.borne,
// settle.holding).
template <class View, class Others>
void take_up_loads(const View& d, const StepRules& rules, const Executor& executor, ContactLists& lists,
                   ImpactTally& tally, Others&& others) {
  SettleLists& settle = lists.settle;
  const Patches& patches = lists.patches;
  assign_amply(lists.tallies, patches.count(), {});
  run_patches(patches, false, executor, [&](std::size_t q) {
    visit_supports(lists, q, [&](std::size_t at, std::uint32_t slot) {
      const Support support = support_in(settle.batches, slot);
      const double impulse = settle.supports.impulse[slot];
      if (rules.round == 0) shift_by_load(d, support, impulse, rules.dt);
      lists.tallies[q].add_load(settle.placed[at].id2(), support, borne(settle.supports, slot, support), rules.box);
      const double force = impulse / rules.dt;  // may underflow to 0
      settle.borne[patches.order[at]] = force;
      settle.holding[at] = force > 0.0 ? 1 : 0;
    });
  });
  add_tallies(lists, others, tally);
}

// Stores the loads of the step in state.loads, in order of ids, from settle.borne.
void keep_loads(State& state, const Executor& executor, ContactLists& lists);

// Solves the supports among the step's pairs; their loads go to state.loads, their impulses to the tally. Precondition:
// settle.borne has the force of each pair in the step, or the round, before.
template <class View, class Others>
void bear_loads(const View& d, State& state, const StepRules& rules, const Executor& executor, ContactLists& lists,
                ImpactTally& tally, Others& others) {
  make_supports(d, state.disks, rules, executor, lists, others);
  SupportSet& set = lists.settle.supports;
  visit_in_contact(lists, executor, [&](std::size_t i) { set.v[i] = {d.vx[i], d.vy[i]}; });
  const PatchSweeps<Others> sweeps{executor, lists, others};
  if (rules.round == 0) {
    run_patches(lists.patches, false, executor, [&](std::size_t q) {
      visit_supports(lists, q, [&](std::size_t, std::uint32_t slot) {
        apply_impulse(set.v.data(), support_in(lists.settle.batches, slot), set.impulse[slot]);
      });
    });
  }
  solve_supports(rules, sweeps);
  visit_in_contact(lists, executor, [&](std::size_t i) {
    d.vx[i] = set.v[i].x;
    d.vy[i] = set.v[i].y;
  });
  take_up_loads(d, rules, executor, lists, tally, others);
  keep_loads(state, executor, lists);
}

}  // namespace carom
