#include "tests/fuzz_scenes/sanity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/disks/disks.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/physics/boundary.hpp"

namespace carom::fuzz {

namespace {

// Rounding, over many collisions.
constexpr double rounding = 1e-9;
// What a warning would have reported: twice the bound of overlaps that only the next step finds.
constexpr double silent_overlap = 0.2;
// TC model under gravity: energy gained, over the energy at the start.
constexpr double silent_heating = 0.01;

// What rounding of energies is measured by.
double size_of(const Energy& energy) {
  return energy.kinetic + std::abs(energy.potential);
}

bool sane(double x) {
  return std::isfinite(x) && x >= 0.0;
}

}  // namespace

Sanity::Sanity(const Scene& scene, const State& start)
    : scene_(scene),
      disks_(start.disks.size()),
      before_(start.counters),
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
  time_ = state.time;
  look_at_places(state);
  look_at_counts(state);
  if (!fault_.empty()) return;
  look_at_overlaps(state);
  look_at_motion(state);
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

// What a disk meets on its way out of a collision is found a step later, and warned of then; by rollback some frames
// later, when the two part.
void Sanity::say_later(const State& state, Unsaid& unsaid, const std::string& found) {
  const int patience = scene_.run.method == Method::rollback ? 30 : 1;
  if (!warnings_.empty()) return;
  if (!unsaid.what.empty() && ++unsaid.steps >= patience) {
    blame(state, fmt::format("{}, {} steps ago and in silence", unsaid.what, unsaid.steps));
  }
  if (unsaid.what.empty()) unsaid.what = found;
}

void Sanity::look_at_counts(const State& state) {
  const Counters& c = state.counters;
  if (disks_ + c.emitted != state.disks.size() + c.removed) {
    blame(state, fmt::format("{} disks and {} emitted, {} removed, but {} left", disks_, c.emitted, c.removed,
                             state.disks.size()));
  }
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

void Sanity::look_at_overlaps(const State& state) {
  Domain box = box_at(scene_.box, state.time);
  const double overlap = max_overlap(state.disks, box);
  const auto obstacles = place_obstacles(state.obstacles, box, motions_of(scene_));
  const double beyond = wall_overlap(state.disks, box);
  if (scene_.run.method == Method::exact) {
    const double smallest = state.disks.empty() ? 1.0 : smallest_radius(state.disks);
    const double unit = std::max(scene_.box.width, scene_.box.height) / smallest * 0x1p-52;
    const double allowed = 1e-11 + 64.0 * unit;
    const bool through_sinks = has_sinks(scene_);  // a disk that leaves may stand beyond it
    if (overlap > allowed) blame(state, fmt::format("two disks overlap by {} of the sum of their radii", overlap));
    if (beyond > allowed && !through_sinks)
      blame(state, fmt::format("a disk is beyond a wall or an obstacle by {} radii", beyond));
    return;
  }
  say_later(state, unsaid_overlap_, overlap > silent_overlap ? fmt::format("an overlap of {}", overlap) : "");
}

// Momentum and energy, where nothing gives or takes any.
void Sanity::look_at_motion(const State& state) {
  const Physics& p = scene_.physics;
  const Domain& box = scene_.box;
  if (p.diffusion > 0.0 || !scene_.sources.empty() || has_sinks(scene_) || box.has_thermal_side() ||
      p.thermostat.acts())
    return;
  const bool stands = !state.obstacles.empty() || p.surfaces.walls.acts();  // what takes momentum, as walls do
  const Momentum now = momentum_of(state.disks);
  largest_momentum_ = std::max(largest_momentum_, now.magnitude);
  if (!stands && box.periodic_x() && p.gravity.left == 0.0 && !box.shear.acts() &&
      std::abs(now.x - momentum_.x) > rounding * largest_momentum_) {
    blame(state, fmt::format("momentum along x went from {} to {}", momentum_.x, now.x));
  }
  if (!stands && box.periodic_y() && p.gravity.down == 0.0 &&
      std::abs(now.y - momentum_.y) > rounding * largest_momentum_) {
    blame(state, fmt::format("momentum along y went from {} to {}", momentum_.y, now.y));
  }
  const bool falls_for_ever =
      (p.gravity.down != 0.0 && box.periodic_y()) || (p.gravity.left != 0.0 && box.periodic_x());
  if (falls_for_ever) return;
  if (p.gravity.acts() && scene_.run.method != Method::exact) return;  // right to first order
  double work = state.counters.shear_work + state.counters.wall_work;  // and by sides that move
  for (const double of_side : state.counters.side_energy) work += of_side;
  const Energy all = energy_of(state.disks, p.gravity);
  const double energy = all.total() - work;
  largest_energy_ = std::max(largest_energy_, size_of(all) + std::abs(work));
  const bool elastic =
      !disks_dissipate(scene_) && !box.walls_dissipate() && !inner_walls_dissipate(scene_) && !walls_rub(scene_);
  const double gain = energy - energy_.total();
  const bool heats = p.gravity.acts() && p.collapse_contact_time.has_value();
  const double allowed = (heats ? silent_heating : rounding) * largest_energy_;
  if (gain > allowed && warnings_.empty())
    blame(state, fmt::format("energy went from {} to {}", energy_.total(), energy));
  if (elastic && !heats && gain < -allowed)
    blame(state, fmt::format("energy went from {} to {}", energy_.total(), energy));
}

}  // namespace carom::fuzz
