#include "core/reference/step_contacts.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/physics/impact_tally.hpp"
#include "core/physics/resting.hpp"
#include "core/physics/support_solver.hpp"
#include "core/reference/pair_search.hpp"

namespace carom {

namespace {

template <class View>
void resolve_impacts(const View& d, const State& state, const StepRules& rules, const std::vector<ContactEvent>& events,
                     const std::vector<std::uint32_t>& contacts, CollisionLog* log, ImpactTally& tally) {
  bool any = true;
  for (int pass = 0; pass < most_impact_passes && any; ++pass) {
    any = false;
    for (const ContactEvent& e : events) {
      const bool crowded = is_crowded(contacts, e);
      if (pass > 0 && !crowded) continue;
      if (rules.settles && is_support(d, rules, e, {.loaded = load_of(state.loads, e) > 0.0, .crowded = crowded}))
        continue;
      const Impact impact = resolve_event(d, rules, e);
      tally.add(e.id2, impact);
      const bool happened = has_happened(impact);
      if (log != nullptr && happened && !is_wall(e.id2)) log->emplace_back(e.id1, e.id2);
      any = any || (crowded && happened);
    }
  }
}

// Sweeps over supports in order of ids.
struct Sweeps {
  const std::vector<Support>& supports;
  SupportSet& set;
  const std::vector<std::uint32_t>& contacts;

  template <Watch watch>
  CycleFigures cycle() const {
    CycleFigures figures;
    for (std::size_t k = 0; k < supports.size(); ++k) relax_forward<watch>(set, k, supports[k], figures);
    for (std::size_t k = supports.size(); k-- > 0;) relax_back<watch>(set, k, supports[k], figures);
    if constexpr (watch == Watch::all) add_products(set, 0, supports.size(), figures);
    return figures;
  }
  SupportTotals totals() const {
    SupportTotals all;
    for (std::size_t k = 0; k < supports.size(); ++k) all.add(set.impulse[k], supports[k].effective);
    return all;
  }
  void extrapolate(double momentum) const {
    extrapolate_impulses(set, 0, supports.size(), momentum);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i] > 0) extrapolate_velocity(set.v[i], set.last_v[i], momentum);
    }
  }
};

// Fills `supports` with the supports among the events and `loads` with their contacts; returns the other columns.
template <class View>
SupportSet make_supports(const View& d, const State& state, const StepRules& rules,
                         const std::vector<ContactEvent>& events, const std::vector<std::uint32_t>& contacts,
                         std::vector<Support>& supports, std::vector<ContactLoad>& loads) {
  SupportSet set;
  for (const ContactEvent& e : events) {
    const double force = load_of(state.loads, e);
    if (!is_solved(d, rules, e, {.loaded = force > 0.0, .crowded = is_crowded(contacts, e)})) continue;
    const std::size_t k = loads.size();
    loads.push_back({e.id1, e.id2, 0.0});
    for (auto* column : {&set.impulse, &set.last, &set.before, &set.ahead, &set.counted, &set.contact_distance}) {
      column->push_back(0.0);
    }
    supports.push_back(make_support(d, rules, e));
    begin_support(set, k, d, rules, e, force);
  }
  set.v.resize(contacts.size());
  set.last_v.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) set.v[i] = {d.vx[i], d.vy[i]};
  return set;
}

// Solves the supports and stores their loads in state.loads, in the order of ids that the events have.
template <class View>
void bear_loads(const View& d, State& state, const StepRules& rules, const std::vector<ContactEvent>& events,
                const std::vector<std::uint32_t>& contacts, ImpactTally& tally) {
  std::vector<ContactLoad> loads;
  std::vector<Support> supports;
  SupportSet set = make_supports(d, state, rules, events, contacts, supports, loads);
  if (rules.round == 0) {
    for (std::size_t k = 0; k < loads.size(); ++k) apply_impulse(set.v.data(), supports[k], set.impulse[k]);
  }
  solve_supports(rules, Sweeps{supports, set, contacts});
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    d.vx[i] = set.v[i].x;
    d.vy[i] = set.v[i].y;
  }
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (rules.round == 0) shift_by_load(d, supports[k], set.impulse[k], rules.dt);
    tally.add_load(loads[k].id2, supports[k], borne(set, k, supports[k]), rules.box);
    loads[k].force = set.impulse[k] / rules.dt;  // may underflow to 0
  }
  std::erase_if(loads, [](const ContactLoad& load) { return load.force == 0.0; });
  state.loads = std::move(loads);
}

// One sweep over all contacts; then sweeps over the crowded ones, which can press one another together again, until no
// overlap is deep.
template <class View>
void push_all(const View& d, const State& state, const StepRules& rules, const std::vector<ContactEvent>& events,
              const std::vector<std::uint32_t>& contacts) {
  bool any_pushed = true;
  for (int sweep = 0; sweep < push_sweeps(rules) && any_pushed; ++sweep) {
    any_pushed = false;
    for (const ContactEvent& e : events) {
      const bool loaded = rules.settles && load_of(state.loads, e) > 0.0;
      any_pushed =
          push_in_sweep(d, rules, e, sweep, {.loaded = loaded, .crowded = is_crowded(contacts, e)}) || any_pushed;
    }
  }
}

}  // namespace

std::vector<std::uint32_t> contacts_per_disk(std::size_t disks, const std::vector<ContactEvent>& events) {
  std::vector<std::uint32_t> contacts(disks, 0);
  for (const ContactEvent& e : events) {
    ++contacts[e.i1];
    if (!is_wall(e.id2)) ++contacts[e.i2];
  }
  return contacts;
}

std::vector<ContactEvent> contacts_after_drift(Disks& disks, const StepRules& rules) {
  std::vector<ContactEvent> events;
  const std::vector<Pair> pairs = find_touching_pairs(disks, rules.box);
  with_view(disks, rules, [&](const auto& d) {
    for (const Pair& p : pairs) events.push_back(pair_event(d, rules, p.i1, p.i2));
    for (std::size_t i = 0; i < disks.size(); ++i) {
      for_each_wall_contact(d, rules, static_cast<std::uint32_t>(i),
                            [&](const ContactEvent& e) { events.push_back(e); });
    }
  });
  return events;
}

StepFigures resolve_serially(State& state, const StepRules& rules, std::vector<ContactEvent>& events,
                             CollisionLog* log) {
  std::sort(events.begin(), events.end(), event_order);
  StepFigures figures;
  with_view(state.disks, rules, [&](const auto& d) {
    const std::vector<std::uint32_t> contacts = contacts_per_disk(state.disks.size(), events);
    for (const ContactEvent& e : events) {
      const bool bore =
          load_of(state.loads, e) > 0.0 && is_crowded(contacts, e);  // its overlap was noted at the end of that step
      if (rules.round == 0 && !is_wall(e.id2) && !bore) note_overlap_before(d, rules, e.i1, e.i2, figures);
    }
    ImpactTally tally;
    resolve_impacts(d, state, rules, events, contacts, log, tally);
    std::sort(events.begin(), events.end(), ids_order);
    if (rules.settles) bear_loads(d, state, rules, events, contacts, tally);
    tally.count_into(state.counters);
    figures.inaccurate = tally.inaccurate;
    figures.inaccurate_at_walls = tally.inaccurate_at_walls;
    push_all(d, state, rules, events, contacts);
    for (const ContactEvent& e : events) note_overlap_left(d, rules.box, e, figures);
    for (std::uint32_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i] > 0) raise_to_wall_overlap(d, rules.box, i, figures);
    }
  });
  return figures;
}

}  // namespace carom
