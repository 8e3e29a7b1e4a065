#include "parallel/stepping/rollback.hpp"

#include <algorithm>
#include <utility>

#include "core/step/rollback_frame.hpp"
#include "core/step/step_clock.hpp"
#include "parallel/stepping/time_stepping.hpp"

namespace carom {

namespace {

// Disks a block of the pass along the walls.
constexpr std::size_t wall_block = 8192;

class ParallelRollback final : public TimeStepping {
 public:
  ParallelRollback(const Scene& scene, State initial, const Threads& threads)
      : TimeStepping(scene, std::move(initial), threads), clock_(make_step_clock(scene.run.dt, scene.run.t_end)) {}

  void step() override {
    if (state_.time >= scene_.run.t_end) return;
    begin_frame();
    const double end = frame_limit(scene_, state_, clock_);
    const double length = std::min(scene_.run.dt / static_cast<double>(parts(scene_.run.dt)), end - state_.time);
    const double back = go(rules_for(scene_, length));
    state_.time = back == 0.0 && state_.time + length >= end ? end : std::min(end, state_.time + (length - back));
    remove_at_sinks();
    ++state_.counters.steps;
    validity_.see_step(scene_, lists_.figures, state_);
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

  // Returns the time by which everything went back.
  double go(const StepRules& rules) {
    sort_if_due();
    drift(rules.dt);
    search(rules);
    gather(rules);
    double back = 0.0;
    lists_.figures = {};
    keep_events(lists_, executor_, [&](const ContactEvent& e) {
      if (is_met(state_.disks, rules, e)) return true;
      lists_.figures.left.see(parting_overlap(state_.disks, rules, e));
      return false;
    });
    for (const ContactEvent& e : lists_.events) back = std::max(back, e.ago);
    if (back > 0.0) drift(-back);
    for (const ContactEvent& e : lists_.events) {
      if (!is_alone(lists_, e) && is_at_a_distance(rules, e, back)) ++lists_.figures.inaccurate;
    }
    const PhaseTimer timer(times_, "resolve");
    ImpactTally tally;
    bounce(rules, tally);
    meet_all_walls(rules, tally);
    tally.count_into(state_.counters);
    return back;
  }

  // All pairs found bounce in canonical order; those that share no disk with another commute.
  void bounce(const StepRules& rules, ImpactTally& tally) {
    with_view(state_.disks, [&](const auto& d) {
      split_crowded(executor_, lists_, tally, [&](const ContactEvent& e, ImpactTally& block) {
        block.add(e.id2, bounce_pair(d, rules, e.i1, e.i2));
      });
    });
    bounce_all(state_.disks, rules, lists_.crowded, tally);
    finish_contacts();
  }

  void meet_all_walls(const StepRules& rules, ImpactTally& tally) {
    if (!rules.box.has(SideKind::wall)) return;
    const std::size_t n = state_.disks.size();
    lists_.tallies.assign(executor_.blocks(n, wall_block), {});
    with_view(state_.disks, [&](const auto& d) {
      executor_.for_ranges(n, wall_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          meet_walls(d, rules, static_cast<std::uint32_t>(i), lists_.tallies[b]);
          if (rules.box.periodic_x()) d.x[i] = wrap(d.x[i], rules.box.width);
          if (rules.box.periodic_y()) d.y[i] = wrap(d.y[i], rules.box.height);
        }
      });
    });
    for (const ImpactTally& t : lists_.tallies) tally.add(t);
    if (rules.gravity > 0.0) forget_speeds();  // a ceiling sends a disk down faster than it came
  }

  StepClock clock_;
};

}  // namespace

std::unique_ptr<Engine> make_parallel_rollback(const Scene& scene, State initial, const Threads& threads) {
  return std::make_unique<ParallelRollback>(scene, std::move(initial), threads);
}

}  // namespace carom
