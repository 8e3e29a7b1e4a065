#include "tests/fuzz_scenes/sanity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/disks/disks.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/physics/boundary.hpp"
#include "tests/fuzz_scenes/closest.hpp"

namespace carom::fuzz {

namespace {

// Allowance for rounding over many collisions.
constexpr double rounding = 1e-9;
// Overlaps above this must be warned of: it is a little more than the bound, as some are found only in the next step.
constexpr double silent_overlap = 0.11;
// In the TC model under gravity: energy gained, relative to that at the start.
constexpr double silent_heating = 0.01;

// The scale for the rounding of energies.
double size_of(const Energy& energy) {
  return energy.kinetic + std::abs(energy.potential);
}

// The overlap allowed for two disks, or for a disk and a wall, in exact runs; over the smallest radius.
double allowed_overlap(const Scene& scene, const Disks& disks) {
  const double smallest = disks.empty() ? 1.0 : smallest_radius(disks);
  return 1e-11 + 64.0 * 0x1p-52 * std::max(scene.box.width, scene.box.height) / smallest;
}

bool sane(double x) {
  return std::isfinite(x) && x >= 0.0;
}

}  // namespace

Sanity::Sanity(const Scene& scene, const State& start)
    : scene_(scene),
      disks_(start.disks.size()),
      before_(start.counters),
      obstacles_(start.obstacles),
      energy_(energy_of(start.disks, scene.physics.gravity)),
      momentum_(momentum_of(start.disks)),
      largest_energy_(size_of(energy_)),
      largest_momentum_(momentum_.magnitude) {}

void Sanity::blame(const State& state, const std::string& what) {
  if (fault_.empty())
    fault_ = fmt::format("insane at t = {} after {} steps: {}", state.time, state.counters.steps, what);
}

void Sanity::look(const State& state, const std::string& warnings) {
  warnings_ += warnings;
  if (!(state.time >= time_ && state.time <= scene_.run.t_end)) {
    blame(state, fmt::format("time went from {} to {} with t_end = {}", time_, state.time, scene_.run.t_end));
  }
  look_at_sources(state, time_);
  time_ = state.time;
  look_at_places(state);
  look_at_counts(state);
  if (!fault_.empty()) return;
  look_at_overlaps(state);
  look_at_momentum(state);
  look_at_energy(state);
}

void Sanity::look_at_places(const State& state) {
  const Disks& d = state.disks;
  std::string outside;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const bool numbers =
        std::isfinite(d.x[i]) && std::isfinite(d.y[i]) && std::isfinite(d.vx[i]) && std::isfinite(d.vy[i]);
    const bool inside = d.x[i] >= 0.0 && d.x[i] <= scene_.box.width && d.y[i] >= 0.0 && d.y[i] <= scene_.box.height;
    if (numbers && inside) continue;
    outside = fmt::format("disk {} at ({}, {}) with velocity ({}, {})", d.id[i], d.x[i], d.y[i], d.vx[i], d.vy[i]);
    if (!numbers || scene_.run.method == Method::exact) blame(state, outside);
  }
  say_later(state, unsaid_place_, outside);
}

// An overlap that a disk gets into after a collision is found a step later, and warned of then; in rollback some frames
// later, when the two separate.
void Sanity::say_later(const State& state, Unsaid& unsaid, const std::string& found) {
  const int patience = scene_.run.method == Method::rollback ? 30 : 1;
  if (!warnings_.empty()) return;
  if (!unsaid.what.empty() && ++unsaid.steps >= patience) {
    blame(state, fmt::format("{}, {} steps ago and in silence", unsaid.what, unsaid.steps));
  }
  if (unsaid.what.empty()) unsaid.what = found;
}

void Sanity::look_within(const Disks& disks, double time) {
  if (scene_.run.method != Method::exact || !fault_.empty()) return;
  const Closest closest = closest_of(disks, obstacles_, scene_, time);
  if (closest.gap < -allowed_overlap(scene_, disks)) {
    fault_ = fmt::format("insane at t = {}: {} by {} radii of the smallest", time, closest.what, -closest.gap);
  }
}

void Sanity::look_at_counts(const State& state) {
  const Counters& c = state.counters;
  if (disks_ + c.emitted != state.disks.size() + c.removed) {
    blame(state, fmt::format("{} disks and {} emitted, {} removed, but {} left", disks_, c.emitted, c.removed,
                             state.disks.size()));
  }
  const Count taken = std::accumulate(state.taken.begin(), state.taken.end(), Count{0});
  if (taken != c.removed) blame(state, fmt::format("{} removed, but sinks took {}", c.removed, taken));
  constexpr Count most = Count{1} << 62U;
  if (c.collisions > most || c.wall_collisions > most || c.waiting > most) blame(state, "a count below 0");
  if (c.collisions < before_.collisions || c.wall_collisions < before_.wall_collisions || c.removed < before_.removed ||
      c.emitted < before_.emitted || c.virial < before_.virial) {
    blame(state, "a count that went down");
  }
  for (const Side side : all_sides) {
    const double impulse = c.wall_impulse[static_cast<std::size_t>(side)];
    if (!sane(impulse)) blame(state, fmt::format("an impulse of {} on a side", impulse));
    if (scene_.box.side(side) != SideKind::wall && impulse != 0.0) blame(state, "an impulse on a side without wall");
  }
  if (!sane(c.virial)) blame(state, fmt::format("a virial of {}", c.virial));
  before_ = c;
}

// The k-th disk of a source is due at k / rate: all disks due have come, or wait. A step handles those due at its
// start, a frame of rollback those due at the start of its dt.
void Sanity::look_at_sources(const State& state, double before) {
  double least = 0.0, most = 0.0;
  for (const Source& source : scene_.sources) {
    const double limit = source.limit ? static_cast<double>(*source.limit) : HUGE_VAL;
    const double seen = scene_.run.method == Method::rollback ? before - scene_.run.dt : before;
    const double since = scene_.run.method == Method::exact ? state.time : std::max(seen, 0.0);
    least += std::min(limit, std::floor(source.rate * since * (1.0 - rounding)));
    most += std::min(limit, std::floor(source.rate * state.time * (1.0 + rounding)));
  }
  const auto due = static_cast<double>(state.counters.emitted + state.counters.waiting);
  if (due < least || due > most) {
    blame(state, fmt::format("{} emitted and {} waiting where {} to {} are due", state.counters.emitted,
                             state.counters.waiting, least, most));
  }
}

void Sanity::look_at_overlaps(const State& state) {
  Domain box = box_at(scene_.box, state.time);
  const double overlap = max_overlap(state.disks, box);
  const auto obstacles = place_obstacles(state.obstacles, box, motions_of(scene_));
  const double beyond = wall_overlap(state.disks, box);
  if (scene_.run.method == Method::exact) {
    const double allowed = allowed_overlap(scene_, state.disks);
    const bool through_sinks = has_sinks(scene_);  // a disk that leaves may be beyond the side
    if (overlap > allowed) blame(state, fmt::format("two disks overlap by {} of the sum of their radii", overlap));
    if (beyond > allowed && !through_sinks)
      blame(state, fmt::format("a disk is beyond a wall or an obstacle by {} radii", beyond));
    return;
  }
  say_later(state, unsaid_overlap_, overlap > silent_overlap ? fmt::format("an overlap of {}", overlap) : "");
}

// The momentum given by sides, moving walls and gravity. Sums of many impulses are rounded like sums of momenta.
void Sanity::look_at_momentum(const State& state) {
  const Physics& p = scene_.physics;
  const Domain& box = scene_.box;
  const bool changes = p.diffusion > 0.0 || !scene_.sources.empty() || has_sinks(scene_) || p.thermostat.acts();
  const bool stands =
      std::any_of(state.obstacles.begin(), state.obstacles.end(), [](const Obstacle& o) { return !o.moves; });
  if (changes || stands || p.surfaces.walls.acts()) return;
  const Momentum now = momentum_of(state.disks);
  largest_momentum_ = std::max(largest_momentum_, now.magnitude);
  const Counters& c = state.counters;
  const auto given = [&](Side low, Side high, std::size_t axis) {
    return c.wall_impulse[static_cast<std::size_t>(low)] - c.wall_impulse[static_cast<std::size_t>(high)] +
           c.wall_push[axis];
  };
  const auto size = [&](Side low, Side high, std::size_t axis, double fallen) {
    return largest_momentum_ + c.wall_impulse[static_cast<std::size_t>(low)] +
           c.wall_impulse[static_cast<std::size_t>(high)] + std::abs(c.wall_push[axis]) + std::abs(fallen);
  };
  double mass = 0.0;
  for (std::size_t i = 0; i < state.disks.size(); ++i) mass += state.disks.mass_of(i);
  const double fallen_x = -mass * p.gravity.left * (state.time);
  const double fallen_y = -mass * p.gravity.down * (state.time);
  const double x = momentum_.x + fallen_x + given(Side::left, Side::right, 0);
  const double y = momentum_.y + fallen_y + given(Side::bottom, Side::top, 1);
  // A thermal side draws the velocity along it, too.
  const bool drawn_x = box.is_thermal(Side::bottom) || box.is_thermal(Side::top);
  const bool drawn_y = box.is_thermal(Side::left) || box.is_thermal(Side::right);
  if (!drawn_x && !box.shear.acts() && std::abs(now.x - x) > rounding * size(Side::left, Side::right, 0, fallen_x)) {
    blame(state,
          fmt::format("momentum along x went from {} to {}, where {} was given", momentum_.x, now.x, x - momentum_.x));
  }
  if (!drawn_y && std::abs(now.y - y) > rounding * size(Side::bottom, Side::top, 1, fallen_y)) {
    blame(state,
          fmt::format("momentum along y went from {} to {}, where {} was given", momentum_.y, now.y, y - momentum_.y));
  }
}

void Sanity::look_at_energy(const State& state) {
  const Physics& p = scene_.physics;
  const Domain& box = scene_.box;
  if (p.diffusion > 0.0) return;
  const bool falls_for_ever =
      (p.gravity.down != 0.0 && box.periodic_y()) || (p.gravity.left != 0.0 && box.periodic_x());
  if (falls_for_ever) return;
  if (p.gravity.acts() && scene_.run.method != Method::exact) return;  // only accurate to first order
  const bool takes = has_sinks(scene_);                                // disks that leave take positive energy
  if (takes && (p.gravity.down < 0.0 || p.gravity.left < 0.0)) return;
  const Counters& c = state.counters;
  double given = c.shear_work + c.wall_work + c.thermostat_heat + c.emitted_energy;
  double size = std::abs(c.shear_work) + std::abs(c.wall_work) + std::abs(c.thermostat_heat) + c.emitted_energy;
  for (const double of_side : c.side_energy) {
    given += of_side;
    size += std::abs(of_side);
  }
  const Energy all = energy_of(state.disks, p.gravity);
  const double energy = all.total() - given;
  largest_energy_ = std::max(largest_energy_, size_of(all) + size);
  const bool elastic = !takes && !disks_dissipate(scene_) && !box.walls_dissipate() && !inner_walls_dissipate(scene_) &&
                       !walls_rub(scene_);
  const double gain = energy - energy_.total();
  const bool heats = p.gravity.acts() && p.collapse_contact_time.has_value();
  const double allowed = (heats ? silent_heating : rounding) * largest_energy_;
  if (gain > allowed && warnings_.empty())
    blame(state, fmt::format("energy went from {} to {}", energy_.total(), energy));
  if (elastic && !heats && gain < -allowed)
    blame(state, fmt::format("energy went from {} to {}", energy_.total(), energy));
}

}  // namespace carom::fuzz
