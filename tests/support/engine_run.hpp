// Runs by the parallel engine on two threads, and the energy that sides have given.
#pragma once

#include <iterator>
#include <numeric>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/simulation.hpp"

namespace carom::test {

// Calls see(state) after every step.
template <class See>
State run_by_engine(const Scene& scene, const State& start, See&& see) {
  const auto engine = make_parallel_engine(scene, start, {2, 1});
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    see(engine->state());
  }
  return engine->state();
}

inline State run_by_engine(const Scene& scene, const State& start) {
  return run_by_engine(scene, start, [](const State&) {});
}

// The energy that all sides have given to the disks: heat of thermal sides, work of moving ones.
inline double energy_from_sides(const State& state) {
  return std::accumulate(std::begin(state.counters.side_energy), std::end(state.counters.side_energy), 0.0);
}

}  // namespace carom::test
