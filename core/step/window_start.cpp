#include "core/step/window_start.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/step/source.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/thermostat.hpp"

namespace carom {

namespace {

// A disk that finds no room at so many places waits.
constexpr std::uint32_t places_tried = 32;
// While some wait, but fewer than this, a source tries so many times from one emission time to the next: a narrow one
// is free again when the disk before has moved on. Where more wait there is no room, and each try ends a window.
constexpr Count few_waiting = 8;
constexpr Count tries_an_emission = 4;

// Counts those that are due beyond the source's limit, too: after eight times a full place is full.
bool tries_between(const Source& source, const SourceState& s, double t) {
  const Count waiting = emissions_due(source.rate, t) - s.emitted;
  return waiting > 0 && waiting < few_waiting;
}

// When a source has or tries its next disk, after time t. One that is due at the end of the run, but for rounding, does
// not come: nothing flies after it.
double next_emission(const Source& source, const SourceState& s, double t, double t_end) {
  const double rate = tries_between(source, s, t) ? tries_an_emission * source.rate : source.rate;
  const double next = emission_time(rate, emissions_due(rate, t) + 1);
  return next < (1.0 - emission_rounding) * t_end ? next : t_end;
}

// At time t, an emission time or, where few wait, one in between, but for rounding: a run that goes on beyond its end
// begins with what was due there.
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
