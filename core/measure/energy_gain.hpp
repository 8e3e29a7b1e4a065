// Energy that nothing put into a run.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/measure/run_start.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Energy at the end, over what was put in at the start and by sources, above which it comes from nowhere: for exact
// beyond all rounding, for time stepping beyond its error of first order.
inline constexpr double most_gain_exact = 1e-9;
inline constexpr double most_gain_stepping = 0.01;

// Does gravity act along a periodic axis? A disk that goes round there has its potential energy anew each time.
bool falls_for_ever(const Scene& scene);

// What a run at its end has to say of energy that nothing put in. Brownian motion keeps none; nothing can be said where
// gravity acts along periodic sides, nor where it pulls to the right or up and disks have left.
std::vector<std::string> energy_warnings(const Scene& scene, const RunStart& start, const State& state);

// The same where the energy is known; of state, the disks are not looked at.
std::vector<std::string> energy_warnings(const Scene& scene, const RunStart& start, const State& state,
                                         const Energy& now);

}  // namespace carom
