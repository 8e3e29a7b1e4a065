#include "core/rollback_frame.hpp"

#include <algorithm>
#include <string>

#include "core/check.hpp"

namespace carom {

bool is_met(Disks& disks, const StepRules& rules, const ContactEvent& e) {
  if (is_wall(e.id2)) return false;
  return with_view(disks, [&](const auto& d) { return relative(d, e.i1, e.i2, rules.box).approach() < 0.0; });
}

void bounce_all(State& state, const StepRules& rules, const std::vector<ContactEvent>& events) {
  with_view(state.disks, [&](const auto& d) {
    for (const ContactEvent& e : events) {
      const Relative r = relative(d, e.i1, e.i2, rules.box);
      if (!(r.approach() < 0.0)) continue;
      const Shares share = shares_of(d, e.i1, e.i2);
      const double change = collide(r, share, rules.restitution, d.vx[e.i1], d.vy[e.i1], d.vx[e.i2], d.vy[e.i2]);
      state.counters.virial += reduced_mass(d.mass(e.i1), d.mass(e.i2)) * change;
      ++state.counters.collisions;
    }
  });
}

double frame_limit(const Scene& scene, const State& state, const StepClock& clock) {
  return scene.physics.diffusion > 0.0 ? std::min(clock.end(state.intervals - 1), scene.run.t_end) : scene.run.t_end;
}

void StallGuard::check(const State& state, const Scene& scene) {
  if (++frames_ < watched_frames) return;
  const double advanced = state.time - since_;
  if (advanced < scene.run.dt && state.time < scene.run.t_end) {
    throw PhysicsError("rollback: time stands still at t = " + std::to_string(state.time) + ": the last " +
                       std::to_string(watched_frames) + " frames advanced it by " +
                       std::to_string(advanced / scene.run.dt) + " dt with " + std::to_string(state.disks.size()) +
                       " disks; use --method pairwise");
  }
  since_ = state.time;
  frames_ = 0;
}

}  // namespace carom
