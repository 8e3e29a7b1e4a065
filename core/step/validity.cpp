#include "core/step/validity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.hpp"
#include "core/physics/contact_event.hpp"
#include "core/scene/drawn_velocities.hpp"
#include "core/scene/moving_walls_text.hpp"
#include "core/scene/scene_names.hpp"
#include "core/step/late_collisions.hpp"
#include "core/step/source.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"

namespace carom {

namespace {

// Is the share too large, and the number large enough for a share to mean anything?
bool are_many(Count inaccurate, Count all, double share) {
  return inaccurate > least_inaccurate && exceeds(inaccurate, all, share);
}

std::string wall_name(const State& state, DiskId wall) {
  if (is_obstacle(wall)) return name_of(state.obstacles[obstacle_of(wall)]);
  return fmt::format("{} wall", side_names[static_cast<std::size_t>(wall_side(wall))]);
}

// The line about the deeper of the two.
std::string overlap_text(const Scene& scene, const State& state, const WorstOverlap& disks, const WorstOverlap& wall) {
  const bool of_disks = disks.overlap.size >= wall.overlap.size;
  const WorstOverlap& worst = of_disks ? disks : wall;
  const Overlap& o = worst.overlap;
  const std::string what = of_disks
                               ? fmt::format("two disks overlap by {:.2g} % of the sum of their radii (ids {} and {})",
                                             100.0 * o.size, o.id1, o.id2)
                               : fmt::format("disk {} reaches {:.2g} % of its radius beyond the {}", o.id1,
                                             100.0 * o.size, wall_name(state, o.id2));
  return fmt::format(
      "at time {:g} {}, more than {:g} %: dt = {:g} is too long where disks are pressed together; use a smaller dt{}",
      worst.time, what, 100.0 * largest_overlap, scene.run.dt, or_exact(scene));
}

// The line about an overlap beyond largest_exact_overlap.
std::string missed_text(const State& state, const WorstOverlap& wall) {
  return fmt::format(
      "at time {:g} disk {} reaches {:.2g} % of its radius beyond the {}: a contact was missed, and the run is wrong "
      "from then on; please report this scene",
      wall.time, wall.overlap.id1, 100.0 * wall.overlap.size, wall_name(state, wall.overlap.id2));
}

std::string slow_text(const Scene& scene, const WorstFigure& advance, std::size_t disks) {
  return fmt::format(
      "at time {:g} a frame advances time by {:.2g} dt, with {} disks: time stalls; use run.method = \"pairwise\"{}",
      advance.time, advance.figure, disks, velocities_are_drawn(scene) ? "" : " or \"exact\"");
}

// dt: length of the step, which may be cut at t_end.
std::string split_text(double time, double dt, Count parts) {
  return fmt::format(
      "at time {:g} the fastest disk moves more than half its radius in dt = {:g}: the step is split into {} parts; a "
      "smaller dt would be more accurate",
      time, dt, parts);
}

// Longest step over the period of a vibrating wall. In time stepping the wall moves at its mean speed over each step;
// the mean square of that speed is too low by 4 % if a step is a tenth of the period, by 25 % if it is a quarter.
constexpr double largest_share_of_period = 0.1;

// The shortest period of the walls that vibrate, sides and inner walls; HUGE_VAL if none does.
double shortest_period(const Scene& scene) {
  double shortest = HUGE_VAL;
  const auto see = [&](const SideMotion& motion) {
    if (motion.vibrates()) shortest = std::min(shortest, motion.period);
  };
  for (const SideMotion& motion : scene.box.motions) see(motion);
  for (const InnerWall& wall : scene.walls) see(wall.motion.pace);
  return shortest;
}

}  // namespace

void Validity::note_split(State& state, double dt, Count parts) {
  ValidityCounts& seen = state.validity;
  if (static_cast<double>(parts) > seen.parts.figure) seen.parts = {static_cast<double>(parts), state.time};
  if (std::exchange(seen.split_told, true)) return;
  warnings_.push_back(split_text(state.time, dt, parts));
}

void Validity::note_step(const Scene& scene, const StepFigures& figures, State& state) {
  const bool rollback = scene.run.method == Method::rollback;
  note_overlap(scene, figures, state);
  // Supports keep a little overlap, so impacts in a pile are often late without harm; a pile is judged by its overlaps.
  const bool pile = scene.run.method == Method::pairwise && settles(scene);
  if (figures.inaccurate > 0 && !pile) note_inaccurate(scene, figures.inaccurate, state);
  if (figures.inaccurate_at_walls > 0 && !pile) note_late_at_walls(scene, figures.inaccurate_at_walls, state);
  if (rollback) note_advance(scene, state);
  const Overlap& deepest = figures.wall.size > figures.left.size ? figures.wall : figures.left;
  if (scene.box.has_moving_wall() && deepest.size > crushed_overlap) state.validity.crushed = {deepest, state.time};
}

void Validity::note_overlap(const Scene& scene, const StepFigures& figures, State& state) {
  ValidityCounts& seen = state.validity;
  Overlap deepest = figures.left;
  deepest.raise_to(figures.before);
  if (deepest.size > seen.disks.overlap.size) seen.disks = {deepest, state.time};
  if (figures.wall.size > seen.wall.overlap.size) seen.wall = {figures.wall, state.time};
  if (scene.run.method == Method::exact) {
    if (!(figures.wall.size > largest_exact_overlap) || std::exchange(seen.overlap_told, true)) return;
    warnings_.push_back(missed_text(state, {figures.wall, state.time}));
    return;
  }
  const double next_step = std::max(figures.before.size, figures.wall.size);
  if (!(figures.left.size > largest_overlap) && !(next_step > largest_overlap_before)) return;
  if (std::exchange(seen.overlap_told, true)) return;
  warnings_.push_back(overlap_text(scene, state, {deepest, state.time}, {figures.wall, state.time}));
}

void Validity::note_inaccurate(const Scene& scene, Count count, State& state) {
  const Count inaccurate = state.validity.inaccurate += count;
  if (!are_many(inaccurate, collisions_watched(scene, state), largest_inaccurate_share)) return;
  if (std::exchange(state.validity.inaccurate_told, true)) return;
  warnings_.push_back(inaccurate_text(scene, state));
}

void Validity::note_late_at_walls(const Scene& scene, Count count, State& state) {
  const Count late = state.validity.inaccurate_at_walls += count;
  if (!are_many(late, state.counters.wall_collisions, largest_late_share_at_walls)) return;
  if (std::exchange(state.validity.late_at_walls_told, true)) return;
  warnings_.push_back(late_at_walls_text(scene, state));
}

void Validity::note_advance(const Scene& scene, State& state) {
  ValidityCounts& seen = state.validity;
  if (++seen.frames < frames_watched) return;
  const double advance = (state.time - seen.since) / (static_cast<double>(seen.frames) * scene.run.dt);
  if (advance < least_advance && state.time < scene.run.t_end) {
    if (!seen.slow_told || advance < seen.advance.figure) seen.advance = {advance, state.time};
    if (!std::exchange(seen.slow_told, true)) warnings_.push_back(slow_text(scene, seen.advance, state.disks.size()));
  }
  seen.frames = 0;
  seen.since = state.time;
}

bool walls_are_watched(const Scene& scene) {
  return scene.physics.gravity.acts() || scene.box.has_moving_wall() || scene.box.obstacles != nullptr;
}

std::vector<std::string> Validity::take_warnings() {
  return std::exchange(warnings_, {});
}

std::vector<std::string> validity_warnings_so_far(const Scene& scene, const State& state) {
  std::vector<std::string> warnings = worst_moment_warnings(scene, state);
  if (state.validity.inaccurate_told) warnings.push_back(inaccurate_text(scene, state));
  if (state.validity.late_at_walls_told) warnings.push_back(late_at_walls_text(scene, state));
  return warnings;
}

std::vector<std::string> worst_moment_warnings(const Scene& scene, const State& state) {
  const ValidityCounts& seen = state.validity;
  std::vector<std::string> warnings;
  if (seen.split_told) {
    const bool cut = scene.run.method == Method::pairwise;
    const double dt = cut ? std::min(scene.run.dt, scene.run.t_end - seen.parts.time) : scene.run.dt;
    warnings.push_back(split_text(seen.parts.time, dt, static_cast<Count>(seen.parts.figure)));
  }
  if (seen.overlap_told) {
    const bool exact = scene.run.method == Method::exact;
    warnings.push_back(exact ? missed_text(state, seen.wall) : overlap_text(scene, state, seen.disks, seen.wall));
  }
  if (seen.slow_told) warnings.push_back(slow_text(scene, seen.advance, state.disks.size()));
  return warnings;
}

void check_crushed(const Scene& scene, const State& state) {
  const auto& [deepest, time] = state.validity.crushed;
  if (!(deepest.size > crushed_overlap)) return;
  const std::string into =
      is_wall(deepest.id2) ? "the " + wall_name(state, deepest.id2) : fmt::format("disk {}", deepest.id2);
  throw PhysicsError(
      fmt::format("a moving wall leaves no room at t = {}, or dt = {:g} is too long: disk {} reaches {:.2g} % into {} "
                  "({}); use a smaller dt, move the wall less far, or use fewer or smaller disks",
                  time, scene.run.dt, deepest.id1, 100.0 * deepest.size, into, moving_walls_text(scene.box, time)));
}

std::vector<std::string> validity_warnings_at_start(const Scene& scene, double smallest_radius, double fastest) {
  std::vector<std::string> warnings;
  const double period = shortest_period(scene);
  if (scene.run.method != Method::exact && scene.run.dt > largest_share_of_period * period) {
    warnings.push_back(
        fmt::format("a wall vibrates with a period of {:g}, but moves at its mean speed during each dt = {:g}: it "
                    "gives the disks too little energy, or none; use dt <= {:.2g} or run.method = \"exact\"",
                    period, scene.run.dt, largest_share_of_period * period));
  }
  if (!(smallest_radius > 0.0)) return warnings;
  const double side = std::max(scene.box.width, scene.box.height);
  if (smallest_radius < least_radius_share * side) {
    warnings.push_back(
        fmt::format("in a box of length {:g} positions are rounded to {:.2g} of the smallest radius; use a smaller box "
                    "or larger disks",
                    side, side * 0x1p-53 / smallest_radius));
  }
  // With gravity or Brownian motion the speeds at the start mean little.
  const bool steps =
      scene.run.method != Method::exact && scene.physics.diffusion == 0.0 && !scene.physics.gravity.acts();
  const double way = steps ? fastest * scene.run.dt : 0.0;
  const double rounding = side * 0x1p-53;
  if (way > 0.0 && way < least_step_roundings * rounding) {
    warnings.push_back(
        fmt::format("the fastest disk moves by {:.2g} in dt = {:g}, but in a box of length {:g} positions are rounded "
                    "to {:.2g}: motion is lost in rounding; use a longer dt or run.method = \"exact\"",
                    way, scene.run.dt, side, rounding));
  }
  const double step = std::sqrt(2.0 * scene.physics.diffusion * scene.run.dt) / smallest_radius;
  if (step > largest_brownian_step) {
    const double share = largest_brownian_step * smallest_radius;
    warnings.push_back(
        fmt::format("a Brownian disk moves by {:.2g} of the smallest radius in dt = {:g}: collisions are "
                    "wrong; use dt <= {:.2g}",
                    step, scene.run.dt, share * share / (2.0 * scene.physics.diffusion)));
  }
  return warnings;
}

std::vector<std::string> waiting_warnings(const Scene& scene, const State& state, std::string_view when) {
  std::vector<std::string> warnings;
  if (state.counters.waiting == 0) return warnings;
  for (std::size_t s = 0; s < scene.sources.size(); ++s) {
    const Source& source = scene.sources[s];
    const Count emitted = state.sources[s].emitted;
    const Count due = due_before(source, state.time);
    if (due <= emitted) continue;
    const Count waiting = due - emitted;
    const double allowed = std::max(1.0, most_waiting * static_cast<double>(due));
    if (emitted > 0 && static_cast<double>(waiting) <= allowed) continue;
    warnings.push_back(
        fmt::format("{} time {:g}, {} of the {} disks due from sources.{} still wait for room: use a lower "
                    "rate, a limit, or more room where they come in",
                    when, state.time, waiting, due, s));
  }
  return warnings;
}

}  // namespace carom
