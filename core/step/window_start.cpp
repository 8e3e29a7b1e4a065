#include "core/step/window_start.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/step/source.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/thermostat.hpp"

namespace carom {

namespace {

// Places tried for a disk before it has to wait.
constexpr std::uint32_t places_tried = 32;
// While fewer than few_waiting disks wait, a source tries tries_an_emission times in each interval between emissions: a
// narrow source is free again when the disk before has moved on. If more wait there is no room, and each try would end
// a window.
constexpr Count few_waiting = 8;
constexpr Count tries_an_emission = 4;

// Counts disks beyond the source's limit, too, so that even the last ones are not tried for ever.
bool tries_between(const Source& source, const SourceState& s, double t) {
  const Count waiting = emissions_due(source.rate, t) - s.emitted;
  return waiting > 0 && waiting < few_waiting;
}

// The time after t at which a source emits or tries its next disk. A disk that is due at the end of the run, up to
// rounding, does not come: no motion follows it.
double next_emission(const Source& source, const SourceState& s, double t, double t_end) {
  const double rate = tries_between(source, s, t) ? tries_an_emission * source.rate : source.rate;
  const double next = emission_time(rate, emissions_due(rate, t) + 1);
  return next < (1.0 - emission_rounding) * t_end ? next : t_end;
}

// Emits if state.time is an emission time or, while few disks wait, a time in between, up to rounding: a run that is
// extended begins with the disks that were due at its old end.
void emit_now(const Scene& scene, const Domain& box, State& state, std::size_t index,
              const std::function<bool(const Disk&)>& room) {
  const Source& source = scene.sources[index];
  const double rate = tries_an_emission * source.rate;
  const Count tries = emissions_due(rate, state.time);
  const Count between = tries % tries_an_emission;
  const bool now = tries > 0 && emission_time(rate, tries) >= (1.0 - emission_rounding) * state.time;
  if (!now || (between > 0 && !tries_between(source, state.sources[index], state.time))) return;
  const Count k = tries / tries_an_emission;
  const PlacesTried places{places_tried, static_cast<std::uint32_t>(between) * places_tried};
  emit_from_source(scene, box, state, index, k, k, places, room);
}

}  // namespace

double next_cut(const Scene& scene, const State& state) {
  double cut = scene.run.t_end;
  for (std::size_t s = 0; s < scene.sources.size(); ++s) {
    const Source& source = scene.sources[s];
    if (!has_more(source, state.sources[s])) continue;
    cut = std::min(cut, next_emission(source, state.sources[s], state.time, scene.run.t_end));
  }
  if (scene.physics.diffusion > 0.0 && state.intervals > 0) {
    cut = std::min(cut, make_step_clock(scene.run.dt, scene.run.t_end).end(state.intervals - 1));
  }
  if (kicks_again(scene, state) && next_kick(scene, state) > state.time) {
    cut = std::min(cut, next_kick(scene, state));
  }
  for (const SideMotion& motion : scene.box.motions) cut = std::min(cut, motion.piece_end(state.time));
  if (!scene.box.inner_walls_move) return cut;
  for (const InnerWall& wall : scene.walls) cut = std::min(cut, wall.motion.pace.piece_end(state.time));
  return cut;
}

void emit_at_window_start(const Scene& scene, State& state, const std::function<bool(const Disk&)>& room) {
  if (scene.sources.empty() || std::exchange(state.step_begun, true)) return;
  const Domain box = box_at(scene.box, state.time);
  for (std::size_t s = 0; s < scene.sources.size(); ++s) {
    if (has_more(scene.sources[s], state.sources[s])) emit_now(scene, box, state, s, room);
  }
  state.counters.waiting = 0;
  for (std::size_t s = 0; s < scene.sources.size(); ++s) {
    state.counters.waiting += due_by(scene.sources[s], state.time) - state.sources[s].emitted;
  }
}

bool brownian_interval_begins(const Scene& scene, const State& state) {
  if (!(scene.physics.diffusion > 0.0)) return false;
  const StepClock clock = make_step_clock(scene.run.dt, scene.run.t_end);
  return state.intervals < clock.steps && (state.intervals == 0 || clock.end(state.intervals - 1) <= state.time);
}

BrownianInterval begin_brownian_interval(const Scene& scene, State& state) {
  const StepClock clock = make_step_clock(scene.run.dt, scene.run.t_end);
  const Count k = state.intervals++;
  return {k, clock.length(k)};
}

}  // namespace carom
