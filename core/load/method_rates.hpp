// The measured costs and errors of the methods, by which check --accuracy and method = "auto" choose. Measured by
// `carom chart`; the laws are those of docs/methods.md.
#pragma once

namespace carom::rates {

// Error of pairwise in collision rate, pressure and cooling rate: second_collision Gamma dt + crowding (Gamma dt)^2 +
// (v dt / sigma)^2 / 4, v^2 = kT / m. The first two terms bound the points of docs/chart.csv (rate and figure of all
// scenes, Gamma dt from 0.02 to 1.3); theory gives at most Gamma dt (docs/methods.md). The last term, for grazing
// collisions, is from theory. Gamma includes collisions with walls and fixed disks: in a slot 1.1 diameters wide, where
// they are 8 of 9, the collision rate of two disks is wrong by 6.0 % with dt = 0.047 and by 4.5 % with 0.033; the law
// gives 8 % and 5 %.
inline constexpr double second_collision = 0.1;
inline constexpr double crowding = 0.2;

// In scenes that settle the energy lost has the further error stopped_in_crowd Gamma dt / (1 - e^2): two disks that a
// third presses together again in the step of their collision are stopped, and so lose all of their relative energy
// instead of the share 1 - e^2 (docs/methods.md). A bound: 200 disks of e = 0.9 to 0.999, with dt = 0.003 and 0.01,
// gave 0.007 at most.
inline constexpr double stopped_in_crowd = 0.01;

// Error of the mean square displacement by the interval of Brownian motion, in any method: this times the number of
// collisions of a disk in an interval. A bound: with 0.27 collisions no error above 3 % was measured (docs/chart.csv,
// brownian).
inline constexpr double brownian_interval = 0.1;

// CPU seconds on one thread of the machine in docs/chart.json, 1000 disks; from the costs in docs/chart.csv.
inline constexpr double pairwise_step = 4.9e-9;        // a disk and step
inline constexpr double pile_step = 0.4e-6;            // more for a disk and step of pairwise in a pile
inline constexpr double obstacle_step = 20e-9;         // more for a disk and step beside inner walls or fixed disks
inline constexpr double pairwise_collision = 0.18e-6;  // a collision
inline constexpr double exact_collision = 0.14e-6;     // a collision, where disks are crowded
inline constexpr double exact_flight = 0.06e-6;        // more for each, over the packing fraction: the longer way to it
inline constexpr double brownian_step = 11.6e-9;       // a disk and interval: two normal deviates
inline constexpr double exact_interval = 103e-9;       // a disk and interval, when exact must stop for it

// pile_step: the higher a pile, the more sweeps its loads need. Productions B and C take 0.2 to 0.4 us, a heap of 2000
// disks 0.4, a settled pile of 10^5 disks 1.2 (docs/benchmarks.md).

// The TC model in a pile: collisions of a disk in a contact time, at rest (docs/methods.md, production B and C).
inline constexpr double pile_collisions = 10.0;

}  // namespace carom::rates
