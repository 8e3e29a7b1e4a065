#include "core/reference/reference_rollback.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "core/reference/reference_engine.hpp"
#include "core/reference/step_contacts.hpp"
#include "core/step/rollback_frame.hpp"
#include "core/step/step_clock.hpp"

namespace carom {

namespace {

class ReferenceRollback final : public ReferenceEngine {
 public:
  ReferenceRollback(const Scene& scene, State initial, CollisionLog* log)
      : ReferenceEngine(scene, std::move(initial)), clock_(make_step_clock(scene.run.dt, scene.run.t_end)), log_(log) {}

  void step() override {
    if (state_.time >= scene_.run.t_end) return;
    begin_frame();
    const double end = frame_limit(scene_, state_, clock_);
    const double length = std::min(scene_.run.dt / static_cast<double>(parts(scene_.run.dt)), end - state_.time);
    const double back = go(length);
    state_.time = back == 0.0 && state_.time + length >= end ? end : std::min(end, state_.time + (length - back));
    remove_at_sinks();
    ++state_.counters.steps;
    validity_.see_step(scene_, figures_, state_);
    check_stall(state_, scene_);
  }

 private:
  void begin_frame() {
    if (scene_.physics.diffusion > 0.0) {
      if (state_.time < clock_.start(state_.intervals)) return;
      const Count k = state_.intervals++;
      start_interval(state_.time, clock_.length(k), k);
    } else {
      start_interval(state_.time, scene_.run.dt, state_.counters.steps);
    }
  }

  // Steps 1 to 5 of the original's frame. Returns the time by which everything went back.
  double go(double length) {
    const StepRules rules = rules_for(scene_, length);
    figures_ = {};
    drift_all(length);
    std::vector<ContactEvent> events;
    {
      const PhaseTimer timer(times_, "search");
      events = find_contacts(state_.disks, rules);
      for (const ContactEvent& e : events) {
        if (!is_met(state_.disks, rules, e)) figures_.left.see(parting_overlap(state_.disks, rules, e));
      }
      std::erase_if(events, [&](const ContactEvent& e) { return !is_met(state_.disks, rules, e); });
      std::sort(events.begin(), events.end(), event_order);
    }
    const PhaseTimer timer(times_, "resolve");
    const double back = events.empty() ? 0.0 : events.front().ago;
    if (back > 0.0) drift_all(-back);
    count_inaccurate(rules, events, back);
    ImpactTally tally;
    bounce_all(state_.disks, rules, events, tally, log_);
    with_view(state_.disks, [&](const auto& d) {
      for (std::size_t i = 0; i < state_.disks.size(); ++i) {
        meet_walls(d, rules, static_cast<std::uint32_t>(i), tally);
      }
    });
    tally.count_into(state_.counters);
    wrap_all();
    return back;
  }

  // Pairs that bounce before they touch, with a disk that bounces in another pair too.
  void count_inaccurate(const StepRules& rules, const std::vector<ContactEvent>& met, double back) {
    std::vector<unsigned> pairs(state_.disks.size(), 0);
    for (const ContactEvent& e : met) ++pairs[e.i1], ++pairs[e.i2];
    for (const ContactEvent& e : met) {
      if (is_at_a_distance(rules, e, back) && pairs[e.i1] + pairs[e.i2] > 2) ++figures_.inaccurate;
    }
  }

  StepClock clock_;
  StepFigures figures_;  // of this frame
  CollisionLog* log_;
};

}  // namespace

std::unique_ptr<Engine> make_reference_rollback(const Scene& scene, State initial, CollisionLog* log) {
  return std::make_unique<ReferenceRollback>(scene, std::move(initial), log);
}

}  // namespace carom
