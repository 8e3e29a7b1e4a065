// What the methods are known to cost and how wrong they are known to be: the constants from which check --accuracy and
// method = "auto" choose. Measured by `carom chart`; the laws are those of docs/methods.md.
#pragma once

namespace carom::rates {

// Error of pairwise in collision rate, pressure and cooling rate: second_collision Gamma dt + crowding (Gamma dt)^2 +
// (v dt / sigma)^2 / 4, v^2 = kT / m. The first two are bounds on the points of docs/chart.csv (rate and figure of all
// scenes, Gamma dt from 0.02 to 1.3); theory says at most Gamma dt (docs/methods.md). The last one, grazing collisions,
// is theory's. Gamma counts collisions with walls and fixed disks as well: in a slot of 1.1 diameters, where 8 of 9 are
// such, the rate of two disks is off by 6.0 % with dt = 0.047 and by 4.5 % with 0.033, for which the law has 8 % and 5
// %.
inline constexpr double second_collision = 0.1;
inline constexpr double crowding = 0.2;

// Where disks settle, more of it: this Gamma dt / (1 - e^2), in the energy lost. Two disks that a third presses
// together again in the step of their collision are stopped, which takes all of what 1 - e^2 is taken from
// (docs/methods.md). A bound on what 200 disks of e = 0.9 to 0.999 lose with dt = 0.003 and 0.01: 0.007 at most.
inline constexpr double stopped_in_crowd = 0.01;

// Error of the interval of Brownian motion itself, in the mean square displacement, whatever the method: this times the
// collisions of a disk in an interval. A bound: with 0.27 of them nothing is seen above 3 % (docs/chart.csv, brownian).
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

// pile_step: the loads of a pile are solved for in sweeps, more of them the higher it is. Productions B and C take 0.2
// to 0.4 us, a heap of 2000 disks 0.4, a settled pile of 10^5 (docs/benchmarks.md) 1.2.

// The TC model in a pile: collisions of a disk in a contact time, at rest (docs/methods.md, production B and C).
inline constexpr double pile_collisions = 10.0;

}  // namespace carom::rates
