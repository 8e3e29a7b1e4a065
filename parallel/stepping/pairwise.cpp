#include "parallel/stepping/pairwise.hpp"

#include <utility>

#include "core/step/step_clock.hpp"
#include "core/step/step_rounds.hpp"
#include "parallel/stepping/time_stepping.hpp"

namespace carom {

namespace {

class ParallelPairwise final : public TimeStepping {
 public:
  ParallelPairwise(const Scene& scene, State initial, const Threads& threads)
      : TimeStepping(scene, std::move(initial), threads), clock_(make_step_clock(scene.run.dt, scene.run.t_end)) {}

  void step() override {
    const Count k = state_.counters.steps;
    if (k >= clock_.steps) return;
    const double dt = clock_.length(k);
    // Once only, even where parts() throws: the state that it leaves can be stepped again.
    if (!std::exchange(state_.step_begun, true)) start_interval(clock_.start(k), dt, k);
    const Count n = parts(dt);
    StepFigures figures;
    for (Count part = 0; part < n; ++part) figures.add(advance(rules_for(scene_, dt / static_cast<double>(n))));
    remove_at_sinks();
    state_.step_begun = false;
    ++state_.counters.steps;
    state_.time = clock_.end(k);
    validity_.see_step(scene_, figures, state_);
  }

 private:
  // In a pile, contacts are searched for and resolved again while resolving presses others together.
  StepFigures advance(StepRules rules) {
    sort_if_due();
    drift(rules.dt);
    if (rules.settles) keep_places();
    StepFigures figures;
    do {
      search(rules);
      resolve(rules);
      figures.go_on(lists_.figures);
    } while (rules.settles && ++rules.round < most_rounds && presses_others());
    return figures;
  }

  StepClock clock_;
};

}  // namespace

std::unique_ptr<Engine> make_parallel_pairwise(const Scene& scene, State initial, const Threads& threads) {
  return std::make_unique<ParallelPairwise>(scene, std::move(initial), threads);
}

}  // namespace carom
