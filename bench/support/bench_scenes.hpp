// The scenes that the benchmarks run, each in a state that is worth measuring: a gas that has forgotten its lattice, a
// pile that has settled.
#pragma once

#include <cstddef>
#include <string>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom::bench {

struct Start {
  Scene scene;  // ends too late to matter
  State state;  // at time 0
};

// Scene G (scenes/gas_million.toml) with count disks, or the same with one of gas_features(). Begins on a hexagonal
// lattice, which is made in a moment even for 10^7 disks, and runs for one unit of time with steps of 0.02: seven
// collisions a disk, after which nothing is left of it.
Start gas(std::size_t count, const std::string& feature = "plain");

// The same run exactly, for some collisions a disk.
Start exact_gas_with(std::size_t count, const std::string& feature);

// The gas of the exact method's figures: scene G with count disks at a packing fraction, run exactly from a lattice for
// four collisions a disk, after which neither speeds nor neighbours remember it (a crystal, above 0.72, stays one).
Start exact_gas(std::size_t count, double packing_fraction = 0.5);

// A hundred disks of radius 50 among 10^6 of radius 0.5, all of one density. The space between the large ones is as
// full of small ones as scene G.
Start wide_radii();

// Production B four times as high and twice as wide (960 disks, about 30 deep), settled, and repeated side by side
// until there are 10^5 disks: a tile takes seconds to settle, the whole would take an hour and lie no quieter.
// tile_disks: fewer make a narrower tile, as deep, which settles sooner.
Start settled_pile(std::size_t tile_disks = 960, std::size_t copies = 104);

// The same disks, stored in random order.
State shuffled(State state);

}  // namespace carom::bench
