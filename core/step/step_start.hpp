// What happens at the start of a step, and the rules that hold during it. Range kernels: the reference calls them on
// all disks, the engine on blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

#include "core/base/random.hpp"
#include "core/disks/disk_view.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/disks/state.hpp"
#include "core/physics/advance.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/resolve.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Is there a wall or an obstacle against which gravity may press disks? Otherwise they fall for ever, or out of the
// box, and no contact bears load.
inline bool has_floor(const Scene& scene) {
  for (const Side side : all_sides) {
    const bool presses = outward_acceleration(side, scene.physics.gravity) > 0.0;
    if (presses && scene.box.side(side) == SideKind::wall) return true;
  }
  const auto is_obstacle = [](const DiskGroup& group) { return group.fixed && group.count > 0; };
  return scene.box.obstacles != nullptr || !scene.walls.empty() ||
         std::any_of(scene.groups.begin(), scene.groups.end(), is_obstacle);
}

// May contacts bear load? For that gravity must press disks against something, and some contacts must dissipate:
// without dissipation no pile comes to rest.
inline bool settles(const Scene& scene) {
  if (!scene.physics.gravity.acts()) return false;
  const auto& walls = scene.box.restitutions;
  const bool dissipates = disks_dissipate(scene) || *std::min_element(walls.begin(), walls.end()) < 1.0;
  return (dissipates || inner_walls_dissipate(scene) || walls_rub(scene)) && has_floor(scene);
}

inline StepRules rules_for(const Scene& scene, double dt) {
  StepRules rules{scene.box, scene.physics.gravity, scene.physics.restitution, dt, settles(scene)};
  rules.whole_dt = scene.run.dt;
  rules.law = law_of(scene);
  rules.surfaces = surfaces_of(scene);
  return rules;
}

// Makes the cells of a run's obstacles, with moving walls at the time of the state, and sets scene.box.obstacles to
// them.
inline std::unique_ptr<ObstacleCells> place_run_obstacles(Scene& scene, const State& state) {
  if (scene.box.inner_walls_move) scene.box.clock = {state.time, state.time};
  return place_obstacles(state.obstacles, scene.box, motions_of(scene));
}

// For parts_of_step: the speed that gravity adds in a step of length dt, plus that of the fastest inner wall, which
// must not jump over a disk either; over the smallest radius; 1 / time.
inline double common_travel(const Scene& scene, double dt, double smallest_radius) {
  const double fall = scene.physics.gravity.size * dt / smallest_radius;
  return scene.box.inner_walls_move ? fall + fastest_inner_wall(scene) / smallest_radius : fall;
}

// With thermal sides: gives every id a count of thermal reflections.
inline void count_thermal_hits(const Scene& scene, State& state) {
  if (scene.box.has_thermal_side()) state.thermal_hits.resize(state.next_id, 0);
}

// The rules of a step from this state. Precondition: the disks of its sources have been emitted.
inline StepRules rules_for(const Scene& scene, State& state, double dt) {
  StepRules rules = rules_for(scene, dt);
  count_thermal_hits(scene, state);
  rules.seed = scene.seed;
  rules.thermal_hits = state.thermal_hits.data();
  return rules;
}

// (24): the velocity of the step becomes u / dt; with accumulate, as in docs/original.md, u / dt is added to it
// (F15).
template <class View>
void draw_brownian(const View& d, const Scene& scene, Count step, double dt, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2 v = brownian_velocity(scene.seed, d.id[i], step, scene.physics.diffusion, dt);
    d.vx[i] = scene.physics.accumulate ? d.vx[i] + v.x : v.x;
    d.vy[i] = scene.physics.accumulate ? d.vy[i] + v.y : v.y;
  }
}

// Largest (speed / radius)^2 of disks [begin, end); 1 / time^2, 0 for an empty range. A maximum: any blocking gives the
// same bits.
template <class View>
double largest_travel2(const View& d, std::size_t begin, std::size_t end) {
  double largest = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const double v2 = d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i];
    largest = std::max(largest, v2 / (d.radius(i) * d.radius(i)));
  }
  return largest;
}

// The side that is a sink and that Brownian disk i crosses during the coming step although both ends of its straight
// path are inside; no_sink if none. The probability of a crossing is exp(-d1 d2 / (D dt)), with the distances d1, d2
// from the side before and after (a Brownian bridge); without it the side would seem 0.5826 sqrt(2 D dt) further out.
// It is compared by its logarithm, which is deterministic; for a disk so far off that no random number could be small
// enough, none is drawn.
template <class View>
SinkNumber sink_crossed(const View& d, const Scene& scene, Count step, double dt, std::size_t i) {
  constexpr double below_any_log = -37.0;  // uniforms are 2^-53 or more, their logarithms -36.74
  const double spread = scene.physics.diffusion * dt;
  for (Side side : all_sides) {
    if (scene.box.side(side) != SideKind::sink) continue;
    const double before = -reach_beyond(side, d.x[i], d.y[i], d.radius(i), scene.box);
    const double after = before - outward_speed(side, d.vx[i], d.vy[i]) * dt;
    if (before <= 0.0 || after <= 0.0) continue;  // contact itself decides
    if (below_any_log * spread > -(before * after)) continue;
    const auto stream = static_cast<Stream>(static_cast<std::uint32_t>(Stream::sink_crossing) +
                                            (static_cast<std::uint32_t>(side) << 8U));
    const double u = uniforms(scene.seed, stream, d.id[i], step).a;
    if (deterministic_log(u) * spread < -(before * after)) return sink_number(side);
  }
  return no_sink;
}

// The sink that disk i touches, the one of the smallest number if there are several; no_sink if none.
template <class View>
SinkNumber sink_touched(const View& d, const Domain& box, std::size_t i) {
  for (Side side : all_sides) {
    const bool sink = box.side(side) == SideKind::sink;
    if (sink && reach_beyond(side, d.x[i], d.y[i], d.radius(i), box) >= 0.0) return sink_number(side);
  }
  return inner_sink_touched(box, d.x[i], d.y[i], d.radius(i));
}

// Is a side or an obstacle a sink?
inline bool has_sinks(const Domain& box) {
  return box.has(SideKind::sink) || (box.obstacles != nullptr && box.obstacles->has_sinks());
}

inline bool has_brownian_sink(const Scene& scene) {
  return scene.physics.diffusion > 0.0 && !scene.physics.accumulate && scene.box.has(SideKind::sink);
}

}  // namespace carom
