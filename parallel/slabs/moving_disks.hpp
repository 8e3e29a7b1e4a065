// Disks that come to a rank's columns from another rank, and leave them again.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/disks/disk_columns.hpp"
#include "core/disks/state.hpp"

namespace carom {

// How often thermal sides have reflected a disk. This is stored by id, and moves with its disk: every rank has entries
// for all ids, but only those of its own disks are right.
inline std::uint32_t thermal_hits_of(const State& state, DiskId id) {
  return id < state.thermal_hits.size() ? state.thermal_hits[id] : 0;
}
inline void take_thermal_hits(State& state, DiskId id, std::uint32_t hits) {
  if (id < state.thermal_hits.size()) state.thermal_hits[id] = hits;
}

// The time of a disk's last collision, stored in the same way.
inline double last_contact_of(const State& state, DiskId id) {
  return id < state.last_contact.size() ? state.last_contact[id] : 0.0;
}

// A disk with all data that move with it.
struct MovingDisk {
  Disk disk;
  double last_contact;
  std::uint32_t thermal_hits;
};

inline MovingDisk moving_disk(const State& state, std::size_t i) {
  const DiskId id = state.disks.id[i];
  return {disk_at(state.disks, i), last_contact_of(state, id), thermal_hits_of(state, id)};
}

// Stores these data without the disk itself.
inline void take_what_goes_along(State& state, const MovingDisk& moving) {
  take_thermal_hits(state, moving.disk.id, moving.thermal_hits);
  if (moving.disk.id < state.last_contact.size()) state.last_contact[moving.disk.id] = moving.last_contact;
}

inline void take_in(State& state, const MovingDisk& moving, DiskColumns columns) {
  push_back(state.disks, moving.disk, columns);
  take_what_goes_along(state, moving);
}

}  // namespace carom
