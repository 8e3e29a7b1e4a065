// The method `rollback`: the sequence of phases of a frame of the original's predictor-corrector. Written once; the
// reference and the parallel engine each supply the phases.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/scene/scene.hpp"
#include "core/step/rollback_frame.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"
#include "core/step/validity.hpp"

namespace carom {

// Phases is an Engine with scene_, state_ and validity_, and with the phases that are called here.
template <class Phases>
class RollbackMethod final : public Phases {
 public:
  // rest: further arguments of the constructor of Phases.
  template <class... Rest>
  RollbackMethod(const Scene& scene, State initial, const Rest&... rest)
      : Phases(scene, std::move(initial), rest...), clock_(make_step_clock(scene.run.dt, scene.run.t_end)) {}

  void step() override {
    if (state_.time >= scene_.run.t_end) return;
    check_crushed(scene_, state_);
    begin_frame();
    const Count disks = all_disks();
    const double begin = state_.time;
    const double end = frame_limit(scene_, state_, clock_);
    const double left = end - state_.time;
    const double length = frame_length(scene_.run.dt / static_cast<double>(parts(scene_.run.dt)), left, end);
    StepFigures figures;
    if (scene_.box.has_moving_wall()) step_walls(scene_.box, obstacles_.get(), state_.time, state_.time + length);
    if (scene_.box.shear.acts()) scene_.box.move_images(state_.time + length);
    const double back = advance(rules_for(scene_, state_, length), figures);
    state_.time = back == 0.0 && length == left ? end : std::min(end, state_.time + (length - back));
    if (scene_.box.inner_walls_move) scene_.box.clock = {state_.time, state_.time};
    remove_at_sinks();
    count_step(state_.counters, disks, all_disks(), state_.time - begin);
    validity_.note_step(scene_, figures, state_);
    check_crushed(scene_, state_);
    check_stall(state_, scene_);
  }

 private:
  using Phases::obstacles_;
  using Phases::scene_;
  using Phases::state_;
  using Phases::validity_;

  using Phases::all_disks;
  using Phases::bounce;
  using Phases::drift;
  using Phases::find_approaching;
  using Phases::is_alone;
  using Phases::kick_if_due;
  using Phases::meet_all_walls;
  using Phases::parts;
  using Phases::remove_at_sinks;
  using Phases::sort_if_due;
  using Phases::start_interval;

  // A frame may end before its Brownian interval does; the next frame then keeps the velocities.
  void begin_frame() {
    if (scene_.physics.diffusion > 0.0) {
      if (state_.time < clock_.start(state_.intervals)) return;
      const Count k = state_.intervals++;
      start_interval(state_.time, clock_.length(k), k);
    } else {
      start_interval(state_.time, scene_.run.dt, state_.counters.steps);
      kick_if_due();
    }
  }

  // Steps 1 to 5 of the original's frame. Returns the time by which all disks went back.
  double advance(StepRules rules, StepFigures& figures) {
    sort_if_due();
    drift(rules.dt);
    const std::vector<ContactEvent>& pairs = find_approaching(rules, figures);
    double back = 0.0;
    for (const ContactEvent& e : pairs) back = std::max(back, e.ago);
    if (back > 0.0 && scene_.box.shear.acts()) {
      scene_.box.move_images(state_.time + (rules.dt - back));
      rules.box = scene_.box;
    }
    if (back > 0.0) drift(-back);
    for (const ContactEvent& e : pairs) {
      if (!is_alone(e) && is_at_a_distance(rules, e, back)) ++figures.inaccurate;
    }
    ImpactTally tally;
    bounce(rules, tally);
    meet_all_walls(back > 0.0 && scene_.box.has_moving_wall() ? gone_back(rules, back) : rules, tally, figures);
    figures.inaccurate_at_walls = tally.inaccurate_at_walls;
    tally.count_into(state_.counters);
    return back;
  }

  // The rules after all disks, and moving walls, have gone back by `back`.
  StepRules gone_back(StepRules rules, double back) const {
    if (back < rules.dt) {
      rules.box.step_walls(state_.time, state_.time + (rules.dt - back));
    } else {
      rules.box.move_walls(state_.time);
    }
    return rules;
  }

  StepClock clock_;
};

}  // namespace carom
