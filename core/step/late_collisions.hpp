// Collisions that time stepping sees a step late, or bounces at one moment with another of the same disk, and those
// that the TC model makes elastic: what is said of them where they are more than their share (core/step/validity.hpp).
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Is it a larger share of all?
bool exceeds(Count inaccurate, Count all, double share);

// The collisions of which some may be inaccurate.
Count collisions_watched(const Scene& scene, const State& state);

// Exact as the other remedy, where it is one: with Brownian motion what a step draws is as coarse.
const char* or_exact(const Scene& scene);

// How many there were by now, why, and the remedy.
std::string inaccurate_text(const Scene& scene, const State& state);
std::string late_at_walls_text(const Scene& scene, const State& state);

// What time stepping at a run's end has to say of those that are more than their share, but too few (least_inaccurate)
// to have been told of on the way: of two collisions or more, and of any bounce off a wall.
std::vector<std::string> few_inaccurate_warnings(const Scene& scene, const State& state);

}  // namespace carom
