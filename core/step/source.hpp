// Sources: disks that enter through a side or appear in a region, one every 1 / rate, never into an overlap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The disk that source number `index` tries to emit in step `step` under identity id, after `emitted` others: place,
// size and velocity drawn by (seed, stream of the source, id, step). Through a side it touches the side (a sink: all
// but touches it) and moves inward; maxwell speeds along the normal are those of a gas behind a hole (flux-weighted,
// v^2 = a^2 + b^2 of two normals), across it plain normal. box: scene.box with its sides where they are; of a side that
// moves, the velocity is that in its frame.
Disk draw_emission(const Scene& scene, const Domain& box, std::size_t index, DiskId id, Count emitted, Count step);

// Does newcomer overlap or touch one of disks first to last - 1 (nearest image)?
bool meets(const Disks& disks, const Domain& box, const Disk& newcomer, std::size_t first, std::size_t last);

// Does the disk fit without overlapping any of disks? Looks at all of them.
bool has_room(const Disks& disks, const Domain& box, const Disk& newcomer);

// At how many places a disk is tried that finds no room, and the number of the first one among those that are drawn in
// a step.
struct PlacesTried {
  std::uint32_t count = 1;
  std::uint32_t first = 0;
};

// Source number `index` emits until it has emitted `due` disks (its limit at most) or one finds no room; adds what
// waits to the waiting count. box: as above.
void emit_from_source(const Scene& scene, const Domain& box, State& state, std::size_t index, Count due, Count step,
                      const PlacesTried& places, const std::function<bool(const Disk&)>& room);

// When a source's k-th disk comes, k = 1, 2, ...: k / rate.
double emission_time(double rate, Count k);

// Number of emission times up to and including t. Exact for a t that is such a quotient.
Count emissions_due(double rate, double t);

// How many disks a source shall have emitted by time t, its limit at most.
Count due_by(const Source& source, double t);

// Times k / rate are rounded, and so are those at which windows and steps end: by less than this share of them.
inline constexpr double emission_rounding = 1e-12;

// How many it gives in a run that ends at t, where all find room: one that is due at t, but for rounding, does not
// come.
Count due_before(const Source& source, double t);

// Has it given fewer than its limit?
bool has_more(const Source& source, const SourceState& s);

// How many disks per unit time come from the sources that have disks left, if all find room.
double emission_rate(const Scene& scene, const State& state);

// The largest radius that a source can give a disk, rounding aside; length.
double largest_radius_of(const Source& source);

// Emits what is due at time t (the k-th disk of a source at k / rate), source by source; a source stops at the first
// disk that finds no room, which waits and is drawn a new place in the next step. room(disk) tells whether a disk fits
// among those present, the ones just appended included. Updates counters, next_id and the waiting count.
void emit_due(const Scene& scene, State& state, double t, Count step, const std::function<bool(const Disk&)>& room);

}  // namespace carom
