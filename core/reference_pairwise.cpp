#include "core/reference_pairwise.hpp"

#include <utility>

#include "core/reference_engine.hpp"
#include "core/step_clock.hpp"
#include "core/step_contacts.hpp"

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
  // Drift, find the overlaps, take each pair and wall in order of contact, push apart what remains.
  StepFigures advance(double dt) {
    const StepRules rules = rules_for(scene_, dt);
    drift_all(dt);
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

  StepClock clock_;
  CollisionLog* log_;
};

}  // namespace

std::unique_ptr<Engine> make_reference_pairwise(const Scene& scene, State initial, CollisionLog* log) {
  return std::make_unique<ReferencePairwise>(scene, std::move(initial), log);
}

}  // namespace carom
