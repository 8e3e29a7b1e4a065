#include "core/window_plan.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/check.hpp"
#include "core/contact_event.hpp"
#include "core/scene_names.hpp"
#include "core/window_start.hpp"

namespace carom {

ExactRules exact_rules(const Scene& scene, const Disks& disks) {
  ExactRules rules;
  rules.box = scene.box;
  rules.gravity = scene.physics.gravity;
  rules.restitution = scene.physics.restitution;
  rules.contact_time = scene.physics.collapse_contact_time.value_or(-1.0);
  rules.common_mass = disks.mass.empty();
  return rules;
}

WindowPlan plan_window(const Scene& scene, const State& state, const SpeedSummary& speeds, double scale) {
  WindowPlan plan;
  plan.start = state.time;
  const double longest = longest_window(scene, speeds, state.disks.size());
  plan.meant = clamped_window(state.window, longest) * scale;
  const double cut = next_cut(scene, state);
  plan.end = state.time + plan.meant;
  plan.length = plan.meant;
  if (!(plan.end < cut)) {
    plan.end = cut;
    plan.length = cut - state.time;
  }
  if (!(plan.end > plan.start) || !std::isfinite(speeds.mean2)) {
    throw PhysicsError(fmt::format(
        "exact: time stands still at t = {}: the fastest disk (speed {}) needs windows of {} time units; use smaller "
        "velocities or a shorter t_end",
        state.time, std::sqrt(speeds.largest2), plan.meant));
  }
  return plan;
}

void finish_window(State& state, const WindowPlan& plan, const ImpactTally& tally, double scale) {
  Counters& c = state.counters;
  tally.count_into(c);
  ++c.steps;
  state.time = plan.end;
  state.window = next_window(plan.meant / scale, plan.length / scale, tally.collisions + tally.wall_collisions,
                             state.disks.size());
}

void fail_collapse(DiskId id1, DiskId id2, double time) {
  const std::string partner = is_wall(id2)
                                  ? fmt::format("the {} wall", side_names[static_cast<std::size_t>(wall_side(id2))])
                                  : fmt::format("disk {}", id2);
  throw PhysicsError(
      fmt::format("exact: inelastic collapse at t = {}: the collisions of disk {} pile up in vanishing time, the last "
                  "one with {}; set physics.collapse = {{ model = \"tc\", contact_time = ... }} (elastic where a disk "
                  "collided less than contact_time ago) or use --method pairwise",
                  time, id1, partner));
}

}  // namespace carom
