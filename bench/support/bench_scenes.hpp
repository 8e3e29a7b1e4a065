// The scenes run by the benchmarks, each in a representative state: a gas that has forgotten its lattice, a pile that
// has settled.
#pragma once

#include <cstddef>
#include <string>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom::bench {

struct Start {
  Scene scene;  // with an end far beyond the benchmark
  State state;  // at time 0
};

// Scene G (scenes/gas_million.toml) with count disks, or the same with one of gas_features(). It starts from a
// hexagonal lattice, which is made quickly even for 10^7 disks, and runs for one unit of time with steps of 0.02: after
// seven collisions per disk nothing is left of the lattice.
Start gas(std::size_t count, const std::string& feature = "plain");

// The same, run with exact for some collisions per disk.
Start exact_gas_with(std::size_t count, const std::string& feature);

// The gas for the figures of the exact method: scene G with count disks at a packing fraction, run with exact from a
// lattice for four collisions per disk, after which neither speeds nor neighbours depend on it (above 0.72 it remains a
// crystal).
Start exact_gas(std::size_t count, double packing_fraction = 0.5);

// A hundred disks of radius 50 among 10^6 of radius 0.5, all of the same density. The space between the large ones is
// as full of small ones as scene G.
Start wide_radii();

// Production B four times as high and twice as wide (960 disks, about 30 layers), settled, and repeated side by side up
// to 10^5 disks: a tile settles in seconds, while the whole would take an hour and not be calmer. tile_disks: fewer
// make a narrower tile of the same depth, which settles sooner.
Start settled_pile(std::size_t tile_disks = 960, std::size_t copies = 104);

// The same disks, stored in random order.
State shuffled(State state);

}  // namespace carom::bench
