#include "core/reference/reference_pairwise.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/reference/pair_search.hpp"
#include "core/reference/reference_engine.hpp"
#include "core/reference/step_contacts.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_rounds.hpp"

namespace carom {

namespace {

class ReferencePairwise final : public ReferenceEngine {
 public:
  ReferencePairwise(const Scene& scene, State initial, CollisionLog* log)
      : ReferenceEngine(scene, std::move(initial)), clock_(make_step_clock(scene.run.dt, scene.run.t_end)), log_(log) {}

  void step() override {
    const Count k = state_.counters.steps;
    if (k >= clock_.steps) return;
    const double dt = clock_.length(k);
    // Once only, even where parts() throws: the state that it leaves can be stepped again.
    if (!std::exchange(state_.step_begun, true)) start_interval(clock_.start(k), dt, k);
    const Count n = parts(dt);
    StepFigures figures;
    for (Count part = 0; part < n; ++part) figures.add(advance(dt / static_cast<double>(n)));
    remove_at_sinks();
    state_.step_begun = false;
    ++state_.counters.steps;
    state_.time = clock_.end(k);
    validity_.see_step(scene_, figures, state_);
  }

 private:
  // Drift, find the overlaps, take each pair and wall in order of contact, push apart what remains; in a pile, again
  // while that presses others together.
  StepFigures advance(double dt) {
    StepRules rules = rules_for(scene_, dt);
    drift_all(dt);
    const std::vector<double> x = state_.disks.x;
    const std::vector<double> y = state_.disks.y;
    StepFigures figures;
    do {
      figures.go_on(find_and_resolve(rules));
    } while (rules.settles && ++rules.round < most_rounds && presses_others(rules.box, x, y));
    return figures;
  }

  StepFigures find_and_resolve(const StepRules& rules) {
    std::vector<ContactEvent> events;
    {
      const PhaseTimer timer(times_, "search");
      events = find_contacts(state_.disks, rules);
    }
    const PhaseTimer timer(times_, "resolve");
    const StepFigures figures = resolve_contacts(state_, rules, events, log_);
    wrap_all();
    return figures;
  }

  // Is a disk that resolving displaced from (x, y) pressed into another or into a wall?
  bool presses_others(const Domain& box, const std::vector<double>& x, const std::vector<double>& y) {
    Disks& disks = state_.disks;
    return with_view(disks, [&](const auto& d) {
      std::vector<unsigned char> displaced(disks.size(), 0);
      bool any = false;
      for (std::size_t i = 0; i < disks.size(); ++i) {
        displaced[i] = is_displaced(d, box, i, x[i], y[i]) ? 1 : 0;
        if (displaced[i] != 0 && is_pressed_into_wall(d, box, i)) return true;
        any = any || displaced[i] != 0;
      }
      if (!any) return false;
      const std::vector<Pair> pairs = find_touching_pairs(disks, box);
      return std::any_of(pairs.begin(), pairs.end(), [&](const Pair& p) {
        return (displaced[p.i1] | displaced[p.i2]) != 0 && are_pressed(d, box, p.i1, p.i2);
      });
    });
  }

  StepClock clock_;
  CollisionLog* log_;
};

}  // namespace

std::unique_ptr<Engine> make_reference_pairwise(const Scene& scene, State initial, CollisionLog* log) {
  return std::make_unique<ReferencePairwise>(scene, std::move(initial), log);
}

}  // namespace carom
