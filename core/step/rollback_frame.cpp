#include "core/step/rollback_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/base/short_number.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/step/overlap_before.hpp"

namespace carom {

bool is_met(Disks& disks, const StepRules& rules, const ContactEvent& e) {
  if (is_wall(e.id2)) return false;
  return with_view(disks, rules, [&](const auto& d) { return relative(d, e.i1, e.i2, rules.box).approach() < 0.0; });
}

void note_overlaps(Disks& disks, const StepRules& rules, const ContactEvent& e, bool met, StepFigures& figures) {
  if (is_wall(e.id2)) return;
  with_view(disks, rules, [&](const auto& d) {
    if (met) return note_overlap_before(d, rules, e.i1, e.i2, figures);
    const double contact_distance = d.radius(e.i1) + d.radius(e.i2);
    const double distance = std::sqrt(distance2_of(d, e.i1, e.i2, rules.box));
    figures.left.raise_to({(contact_distance - distance) / contact_distance, e.id1, e.id2});
  });
}

bool is_at_a_distance(const StepRules& rules, const ContactEvent& e, double back) {
  // Differences below this share of the frame are rounding.
  constexpr double same = 1e-9;
  return back - e.ago > same * rules.dt;
}

void bounce_all(Disks& disks, const StepRules& rules, const std::vector<ContactEvent>& events, ImpactTally& tally,
                CollisionLog* log) {
  with_view(disks, rules, [&](const auto& d) {
    for (const ContactEvent& e : events) {
      const PairImpact impact = bounce_pair(d, rules, e.i1, e.i2);
      tally.add_pair(impact);
      if (log != nullptr && impact.happened) log->emplace_back(e.id1, e.id2);
    }
  });
}

double frame_limit(const Scene& scene, const State& state, const StepClock& clock) {
  return scene.physics.diffusion > 0.0 ? std::min(clock.end(state.intervals - 1), scene.run.t_end) : scene.run.t_end;
}

double frame_length(double step, double left, double end) {
  // Relative to the time; limited relative to the frame, which must not become longer than is safe.
  const double rounding = std::min(1e-12 * end, 1e-3 * step);
  return left - step <= rounding ? left : step;
}

void check_stall(State& state, const Scene& scene) {
  constexpr Count watched_frames = 10000;
  if (++state.stall.frames < watched_frames) return;
  const double advanced = state.time - state.stall.since;
  if (advanced < scene.run.dt && state.time < scene.run.t_end) {
    throw PhysicsError(
        fmt::format("rollback: time stands still at t = {:g}: the last {} frames advanced it by {:g} dt with {}; use "
                    "run.method = \"pairwise\"",
                    state.time, watched_frames, advanced / scene.run.dt, counted(state.disks.size(), "disk")));
  }
  state.stall = {0, state.time};
}

}  // namespace carom
