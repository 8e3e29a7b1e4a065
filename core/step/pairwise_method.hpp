// The method `pairwise`: the sequence of phases of a step. Written once; the reference and the parallel engine each
// supply the phases.
#pragma once

#include <utility>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_rounds.hpp"
#include "core/step/step_start.hpp"
#include "core/step/validity.hpp"

namespace carom {

// Phases is an Engine with scene_, state_ and validity_, and with the phases that are called here.
template <class Phases>
class PairwiseMethod final : public Phases {
 public:
  // rest: further arguments of the constructor of Phases.
  template <class... Rest>
  PairwiseMethod(const Scene& scene, State initial, const Rest&... rest)
      : Phases(scene, std::move(initial), rest...), clock_(make_step_clock(scene.run.dt, scene.run.t_end)) {}

  void step() override {
    const Count k = state_.counters.steps;
    if (k >= clock_.steps) return;
    check_crushed(scene_, state_);
    const double dt = clock_.length(k);
    // Only once in a step, even if parts() throws: the state that is left can be stepped again.
    if (!std::exchange(state_.step_begun, true)) {
      start_interval(clock_.start(k), dt, k);
      kick_if_due();
    }
    const Count disks = all_disks();
    const Count n = parts(dt);
    StepFigures figures;
    const double length = dt / static_cast<double>(n);
    for (Count part = 0; part < n; ++part) {
      const double begin = clock_.start(k) + length * static_cast<double>(part);
      const double end = part + 1 < n ? clock_.start(k) + length * static_cast<double>(part + 1) : clock_.end(k);
      if (scene_.box.has_moving_wall()) step_walls(scene_.box, obstacles_.get(), begin, end);
      if (scene_.box.shear.acts()) scene_.box.move_images(end);
      figures.add(advance(rules_for(scene_, state_, length)));
      if (part + 1 == n || has_inner_sinks()) remove_at_sinks();
    }
    state_.step_begun = false;
    count_step(state_.counters, disks, all_disks(), dt);
    state_.time = clock_.end(k);
    validity_.note_step(scene_, figures, state_);
    check_crushed(scene_, state_);
  }

 private:
  using Phases::obstacles_;
  using Phases::scene_;
  using Phases::state_;
  using Phases::validity_;

  using Phases::all_disks;
  using Phases::drift;
  using Phases::keep_places;
  using Phases::kick_if_due;
  using Phases::parts;
  using Phases::presses_others;
  using Phases::remove_at_sinks;
  using Phases::resolve;
  using Phases::search;
  using Phases::sort_if_due;
  using Phases::start_interval;

  // Inner sinks are tested after each part, since a fast disk may cross them within a step; a disk beyond a side that
  // is a sink stays beyond it to the step's end.
  bool has_inner_sinks() const { return scene_.box.obstacles != nullptr && scene_.box.obstacles->has_sinks(); }

  // Drifts, finds the contacts, resolves them in order of contact and pushes remaining overlaps apart; in a pile again,
  // while that presses other disks together.
  StepFigures advance(StepRules rules) {
    sort_if_due();
    drift(rules.dt);
    StepFigures figures;
    do {
      if (rules.settles) keep_places();
      search(rules);
      figures.go_on(resolve(rules));
    } while (rules.settles && ++rules.round < most_rounds && presses_others());
    return figures;
  }

  StepClock clock_;
};

}  // namespace carom
