// Positions at densities that random addition does not reach: disks are placed small, fly, and grow into the room that
// they find, after Lubachevsky and Stillinger (J. Stat. Phys. 60, 561, 1990).
#pragma once

#include <functional>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "core/start/growth_step.hpp"
#include "core/start/placement.hpp"

namespace carom {

// The progress of a growth. All numbers are 0 while disks are placed at random, before a growth or without one.
struct GrowthProgress {
  Count steps = 0;
  Count collisions = 0;  // so far, of two disks or of a disk and a side
  double packing_fraction = 0.0;
  double final_packing_fraction = 0.0;
};

// The functions that do the work of a growth. The serial and the parallel tools give the same bits.
struct GrowthTools {
  // The state at scene.run.t_end, by the exact method. The function passed to it is called between windows; an
  // exception from it ends the flight.
  std::function<State(const Scene&, State, const std::function<void()>&)> fly;
  // grow_step, or a function that gives the same radii; it may change the order of the disks.
  std::function<GrowthTally(Disks&, const Domain&, const std::vector<double>&)> step;
  // Called after every step, and several times within the flights, which may be long. An exception from it ends the
  // growth. May be empty.
  std::function<void(const GrowthProgress&)> watch;
};
GrowthTools plain_growth();

// Does any group of the scene grow? Then all groups do, except fixed ones (scene_check.hpp).
bool grows(const Scene& scene);

// Gives all disks of the scene places where they do not overlap, to the last bit, by growth. First `place` puts them
// there with radii scaled down to packing fraction 0.25. Then, in turn, they fly a little with fixed radii, elastic and
// of equal mass, between walls in place of sinks, and grow by grow_step. obstacles: fixed disks, which have their
// places in disks already, and inner walls; they stay as they are, and disks bounce off them. Velocities are drawn from
// (seed, Stream::growth_velocity, id) and dropped in the end. Everything follows from counts and lengths, nothing from
// clocks. Preconditions: entry i of disks has id i, radii are final. Throws InputError with the packing fraction
// reached if growth stalls (jams), or after scene.growth.steps steps; and at once if a disk fills the box from wall to
// wall.
void place_by_growth(const Scene& scene, Disks& disks, const std::vector<Obstacle>& obstacles,
                     const PlaceAtRandom& place, const GrowthTools& tools);

}  // namespace carom
