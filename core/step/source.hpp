// Sources: disks that enter through a side or appear in a region, one every 1 / rate, never into an overlap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The disk that source number `index` tries to emit in step `step` with this id, after `emitted` others. Place, size
// and velocity are drawn by (seed, stream of the source, id, step). A disk that enters through a side touches the side
// (a sink: nearly touches it) and moves inwards. With maxwell velocities its speed along the normal has the
// flux-weighted distribution of a gas behind a hole (v^2 = a^2 + b^2 of two normals), and the component along the side
// is normal. box: scene.box with its sides at their present places. Velocities are drawn in the frame of a moving side.
Disk draw_emission(const Scene& scene, const Domain& box, std::size_t index, DiskId id, Count emitted, Count step);

// Does newcomer overlap or touch one of disks first to last - 1 (nearest image)?
bool meets(const Disks& disks, const Domain& box, const Disk& newcomer, std::size_t first, std::size_t last);

// Does newcomer touch none of the disks? Tests all of them.
bool has_room(const Disks& disks, const Domain& box, const Disk& newcomer);

// How many places are tried for a disk, and the number of the first of them among those drawn in a step.
struct PlacesTried {
  std::uint32_t count = 1;
  std::uint32_t first = 0;
};

// Source number `index` emits until it has emitted `due` disks (its limit at most) or one finds no room; disks that
// still wait are added to the waiting count. box: as above.
void emit_from_source(const Scene& scene, const Domain& box, State& state, std::size_t index, Count due, Count step,
                      const PlacesTried& places, const std::function<bool(const Disk&)>& room);

// The time at which a source's k-th disk is due, k = 1, 2, ...: k / rate.
double emission_time(double rate, Count k);

// Number of emission times up to and including t. Exact if t is an emission_time.
Count emissions_due(double rate, double t);

// The number of disks due from a source by time t, its limit at most.
Count due_by(const Source& source, double t);

// The relative rounding of emission times, and of the times at which windows and steps end, is less than this.
inline constexpr double emission_rounding = 1e-12;

// The number of disks due from a source in a run that ends at t: a disk that is due at t, up to rounding, does not
// come.
Count due_before(const Source& source, double t);

// Has the source emitted fewer disks than its limit?
bool has_more(const Source& source, const SourceState& s);

// Disks per unit time due from the sources that have not reached their limit.
double emission_rate(const Scene& scene, const State& state);

// The largest radius of a disk from this source, up to rounding; length.
double largest_radius_of(const Source& source);

// Emits the disks due at time t, source by source. A source stops at the first disk that finds no room; that disk
// waits, and gets a new place in the next step. room(disk): does the disk fit among those present, including those just
// appended? Updates the counters and next_id.
void emit_due(const Scene& scene, State& state, double t, Count step, const std::function<bool(const Disk&)>& room);

}  // namespace carom
