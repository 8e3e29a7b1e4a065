#include "core/step/window_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check.hpp"
#include "core/physics/contact_event.hpp"
#include "core/scene/moving_walls_text.hpp"
#include "core/scene/scene_names.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/window_start.hpp"

namespace carom {

namespace {

// Mean length of enough_windows crowded windows in a row, over longest_window, below which the run would not end for
// years. A burst of elastic collisions reaches that only if doubles can no longer resolve it. Under the TC model bursts
// need not end: disks that stay in contact have a dozen collisions in each contact_time, for ever.
constexpr Count enough_windows = 128;
constexpr double least_pace = 0x1p-30;
constexpr double least_pace_tc = 0x1p-20;
// A wall that closes in on disks without room makes them faster and faster, and each window takes longer to compute
// than the one before. So where moving walls push disks, fewer windows and a larger mean length are enough to stop the
// run. If they do not push, the windows are crowded by a burst as anywhere else.
constexpr double least_pace_moving = 0x1p-10;
constexpr Count enough_windows_moving = 32;
static_assert(enough_windows % enough_windows_moving == 0);

// Can any collision lose energy?
bool loses_energy(const Scene& scene) {
  return disks_dissipate(scene) || scene.box.walls_dissipate() || inner_walls_dissipate(scene) || walls_rub(scene);
}

std::string partner_text(const Domain& box, DiskId id) {
  if (is_obstacle(id)) return "the " + name_of((*box.obstacles)[obstacle_of(id)]);
  return is_wall(id) ? fmt::format("the {} wall", side_names[static_cast<std::size_t>(wall_side(id))])
                     : fmt::format("disk {}", id);
}

// Throws the PhysicsError of a run whose time does not advance past this event; the kind of contact tells the reason.
[[noreturn]] void fail_standstill(const ExactRules& rules, const EventMark& event, double start) {
  const bool rests = rules.gravity.acts() && dissipates(rules);
  if (!rules.tc() && (rests || may_lose_energy(rules, event.id1, event.id2))) fail_collapse(rules, event, start);
  if (rules.box.has_moving_wall()) {
    // An elastic disk that starts at rest on a moving wall, or that a source on it emits, may stay on it.
    const bool may_rest = rules.gravity.acts();
    throw PhysicsError(
        fmt::format("exact: time stands still at t = {}: disk {} and {} collide again and again at one moment; {}a "
                    "moving wall may leave them no room ({}): {}move the wall less far, or use fewer or smaller disks",
                    start + event.time, event.id1, partner_text(rules.box, event.id2),
                    may_rest ? "they rest on each other, or " : "", moving_walls_text(rules.box, start + event.time),
                    may_rest ? "use run.method = \"pairwise\", " : ""));
  }
  throw PhysicsError(fmt::format(
      "exact: time stands still at t = {}: disk {} and {} collide again and again at one moment; {}",
      start + event.time, event.id1, partner_text(rules.box, event.id2),
      rules.tc()
          ? "physics.collapse.contact_time is too short for a double to tell such times apart: use a larger one, "
            "or run.method = \"pairwise\""
      : rules.gravity.acts() ? "they rest on each other, or have no room to move: use run.method = \"pairwise\", a "
                               "larger box or smaller disks"
                             : "they have no room to move, or masses differ too much: use a larger box, smaller disks "
                               "or run.method = \"pairwise\""));
}

}  // namespace

bool has_tc(const Scene& scene) {
  return scene.physics.collapse_contact_time && loses_energy(scene);
}

ExactRules exact_rules(const Scene& scene, const Disks& disks, double start) {
  ExactRules rules;
  rules.box = box_at(scene.box, start);
  rules.gravity = scene.physics.gravity;
  rules.restitution = std::max(scene.physics.restitution, least_rebound);
  if (has_tc(scene)) rules.contact_time = *scene.physics.collapse_contact_time;
  rules.seed = scene.seed;
  rules.common_mass = disks.mass.empty();
  rules.law = law_of(scene);
  rules.surfaces = surfaces_of(scene);
  rules.constant = !rules.tc() && rules.law == nullptr;
  return rules;
}

WindowPlan plan_window(const Scene& scene, const State& state, std::size_t disks, const SpeedSummary& speeds,
                       double scale) {
  WindowPlan plan;
  plan.start = state.time;
  plan.disks = disks;
  const double longest = longest_window(scene, speeds, disks);
  plan.meant = clamped_window(state.window, longest) * scale;
  plan.least = least_window(longest) * scale;
  plan.tc = has_tc(scene);
  plan.pace = (plan.tc ? least_pace_tc : least_pace) * longest * scale;
  plan.pace_moving = (plan.tc ? least_pace_tc : least_pace_moving) * longest * scale;
  const double cut = next_cut(scene, state);
  plan.end = state.time + plan.meant;
  // The length is the difference of the rounded times: late in a run their rounding is by far the largest.
  plan.length = plan.end - plan.start;
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

WindowPlan shortened(const WindowPlan& plan, const ExactRules& rules, const EventMark& last) {
  WindowPlan shorter = plan;
  shorter.end = plan.start + 0.5 * last.time;
  shorter.length = shorter.meant = shorter.end - plan.start;
  const bool divided = shorter.end > plan.start && shorter.end < plan.end;
  if (!divided || shorter.length < 0x1p-60 * plan.least) fail_standstill(rules, last, plan.start);
  return shorter;
}

void finish_window(State& state, std::size_t disks, const WindowPlan& plan, const ImpactTally& tally, double scale) {
  Counters& c = state.counters;
  tally.count_into(c);
  add(state.taken, tally.taken);
  const double absence = tally.absence.empty() ? 0.0 : tally.absence[0].value();
  count_step(c, plan.length * static_cast<double>(plan.disks) - absence);
  state.time = plan.end;
  state.step_begun = false;
  const double meant = plan.meant / scale;
  const double next = next_window(meant, plan.length / scale, tally.collisions + tally.wall_collisions, disks);
  const double least = plan.least / scale;
  // Below the least length, windows grow again as soon as they are less crowded, and do not shrink here (shortened).
  const bool stays_below = meant < least && std::max(next, meant) < least;
  state.window = stays_below ? -std::max(next, meant) : next;
}

namespace {

// Have moving walls done work or given momentum in this window?
bool moving_walls_pushed(const Domain& box, const ImpactTally& tally) {
  const auto given = [](const ExactSum& sum) { return sum.value() != 0.0; };
  if (std::ranges::any_of(tally.pushes, given)) return true;
  if (tally.side_energy.empty()) return false;
  return std::ranges::any_of(all_sides, [&](Side side) {
    return box.moves(side) && given(tally.side_energy[static_cast<std::size_t>(side)]);
  });
}

// windows: their number; advanced: by how much they advanced time.
[[noreturn]] void fail_slow(double time, Count windows, double advanced, const std::string& why) {
  throw PhysicsError(
      fmt::format("exact: time almost stands still at t = {}: the last {} windows advanced it by only {:.2g}; {}", time,
                  windows, advanced, why));
}

// The reason if moving walls push disks. Disks that land on a wall with a sine motion may come to rest there, with hops
// for ever; so may elastic disks that gravity presses against a wall from the start.
std::string slow_at_moving_walls(const Scene& scene, const WindowPlan& plan, double time) {
  const bool collapses = !plan.tc && loses_energy(scene);
  const bool may_rest = !plan.tc && (collapses || scene.physics.gravity.acts());
  return fmt::format(
      "{}a moving wall leaves the disks hardly any room ({}): {}{}move the wall less far, or use fewer or smaller "
      "disks",
      collapses  ? "disks come to rest on a wall (inelastic collapse), or "
      : may_rest ? "disks rest on a wall, or "
                 : "",
      moving_walls_text(scene.box, time),
      collapses ? "set physics.collapse = { model = \"tc\", contact_time = ... } or " : "",
      may_rest ? "use run.method = \"pairwise\", " : "");
}

// The reason if no moving wall pushes disks. It may be a collapse: not in every collapse do the collisions of one disk
// pile up within collapse_share of a window.
std::string why_slow(const Scene& scene, const WindowPlan& plan) {
  if (plan.tc) {
    return "physics.collapse.contact_time is too short for disks that stay in contact: use a larger one, or "
           "run.method = \"pairwise\"";
  }
  if (loses_energy(scene)) {
    return "disks come to rest (inelastic collapse), or have hardly any room to move: set physics.collapse = { model = "
           "\"tc\", contact_time = ... }, or use run.method = \"pairwise\", a larger box or smaller disks";
  }
  return "disks have hardly any room to move: use a larger box or smaller disks, or run.method = \"pairwise\"";
}

}  // namespace

void check_pace(const Scene& scene, State& state, const WindowPlan& plan, const ImpactTally& tally) {
  StallWatch& stall = state.stall;
  if (state.window >= 0.0) {
    stall = {};
    return;
  }
  if (stall.frames == 0) stall.since = plan.start;
  if (++stall.frames % enough_windows_moving != 0) return;
  const Count windows = stall.frames;
  const double advanced = state.time - stall.since;
  const auto slower_than = [&](double pace) { return advanced < static_cast<double>(windows) * pace; };
  if (scene.box.has_moving_wall()) {
    if (!slower_than(plan.pace_moving)) {
      stall = {};
      return;
    }
    if (moving_walls_pushed(scene.box, tally)) {
      stall = {};
      fail_slow(state.time, windows, advanced, slow_at_moving_walls(scene, plan, state.time));
    }
  }
  if (windows < enough_windows) return;
  stall = {};
  if (!slower_than(plan.pace)) return;
  fail_slow(state.time, windows, advanced, why_slow(scene, plan));
}

void fail_collapse(const ExactRules& rules, const EventMark& event, double start) {
  throw PhysicsError(
      fmt::format("exact: inelastic collapse at t = {}: disk {} has more and more collisions in less and less time, "
                  "the last one with {}; set physics.collapse = {{ model = \"tc\", contact_time = ... }} (collisions "
                  "less than contact_time after another are elastic) or use run.method = \"pairwise\"",
                  start + event.time, event.id1, partner_text(rules.box, event.id2)));
}

}  // namespace carom
