// A scene of the user's own as one of the speed-accuracy chart.
#pragma once

#include "app/chart/chart_scenes.hpp"
#include "core/scene/scene.hpp"

namespace carom::chart {

// What is measured in it and for how long: paths until a disk has collided twice in the mean, rates until 25 times or
// to t_end, steps from the longest safe one on and the scene's own. Runs it once by exact to find these times. Throws
// InputError, with the remedy, for a scene that cannot be charted: it needs disks that stay, that collide, and that
// exact can carry to there.
ChartScene own_scene(const Scene& scene);

// So many of disks_that_move at most: paths are compared by the plain references, some fifty runs of them.
inline constexpr Count most_own_disks = 20'000;

// How many disks the scene has that costs are given per: not the fixed ones, which are obstacles. Precondition: it has
// no sources.
Count disks_that_move(const Scene& scene);

}  // namespace carom::chart
