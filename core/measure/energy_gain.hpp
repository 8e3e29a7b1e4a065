// A warning about energy that a run has gained without a source of it.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/measure/run_start.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Largest relative gain of energy that gives no warning: for exact above all rounding, for time stepping above its
// error of first order.
inline constexpr double most_gain_exact = 1e-9;
inline constexpr double most_gain_stepping = 0.01;

// Does gravity act along a periodic axis? A disk then regains its potential energy each time it crosses the side.
bool falls_for_ever(const Scene& scene);

// For the end of a run: a line if its energy has grown without a source of it. Always none with Brownian motion, which
// does not conserve energy, if gravity acts along a periodic axis, and if gravity points to the right or up and disks
// have left.
std::vector<std::string> energy_warnings(const Scene& scene, const RunStart& start, const State& state);

// The same with known energy; the disks of state are not used.
std::vector<std::string> energy_warnings(const Scene& scene, const RunStart& start, const State& state,
                                         const Energy& now);

}  // namespace carom
