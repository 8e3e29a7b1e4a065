// A user's own scene as a scene of the speed-accuracy chart.
#pragma once

#include "app/chart/chart_scenes.hpp"
#include "core/scene/scene.hpp"

namespace carom::chart {

// The scene with what is measured in it and for how long: paths until a disk has collided twice on average, rates until
// 25 times or to t_end, with steps from the longest safe one down and the scene's own step. Runs the scene once by
// exact to find these times. Throws InputError, with the remedy, for a scene that cannot be charted: its disks must
// stay, they must collide, and exact must be able to run it that far.
// exact can carry to there.
ChartScene own_scene(const Scene& scene);

// The largest disks_that_move: paths are compared by the plain references, in some fifty runs.
inline constexpr Count most_own_disks = 20'000;

// The number of disks by which costs are divided: without fixed ones, which are obstacles. Precondition: the scene has
// no sources.
Count disks_that_move(const Scene& scene);

}  // namespace carom::chart
