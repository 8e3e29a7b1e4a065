// Disks that come to a rank's columns from another one, and go again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/state.hpp"

namespace carom {

// Which columns the run's disks have; a rank without disks has empty ones all the same.
struct DiskColumns {
  bool radius = false, mass = false, spin = false;
};

inline DiskColumns columns_of(const Disks& d) {
  return {!d.radius.empty(), !d.mass.empty(), d.spins()};
}

inline void push_back(Disks& d, const Disk& disk, DiskColumns columns) {
  d.x.push_back(disk.x);
  d.y.push_back(disk.y);
  d.vx.push_back(disk.vx);
  d.vy.push_back(disk.vy);
  d.id.push_back(disk.id);
  if (columns.radius) d.radius.push_back(disk.radius);
  if (columns.mass) d.mass.push_back(disk.mass);
  if (columns.spin) d.spin.push_back(disk.spin);
}

// Writes a disk over the one that is stored there.
inline void put_at(Disks& d, std::size_t i, const Disk& disk) {
  d.x[i] = disk.x;
  d.y[i] = disk.y;
  d.vx[i] = disk.vx;
  d.vy[i] = disk.vy;
  d.id[i] = disk.id;
  if (!d.radius.empty()) d.radius[i] = disk.radius;
  if (!d.mass.empty()) d.mass[i] = disk.mass;
  if (!d.spin.empty()) d.spin[i] = disk.spin;
}

inline void copy_within(Disks& d, std::size_t from, std::size_t to) {
  for (std::vector<double>* column : {&d.x, &d.y, &d.vx, &d.vy, &d.radius, &d.mass, &d.spin}) {
    if (!column->empty()) (*column)[to] = (*column)[from];
  }
  d.id[to] = d.id[from];
}

// How often thermal sides have reflected a disk: what of a state is by id and goes with its disk. Every rank has
// entries for all ids; those of its own disks are right.
inline std::uint32_t thermal_hits_of(const State& state, DiskId id) {
  return id < state.thermal_hits.size() ? state.thermal_hits[id] : 0;
}
inline void take_thermal_hits(State& state, DiskId id, std::uint32_t hits) {
  if (id < state.thermal_hits.size()) state.thermal_hits[id] = hits;
}

// The same of the time of a disk's last collision.
inline double last_contact_of(const State& state, DiskId id) {
  return id < state.last_contact.size() ? state.last_contact[id] : 0.0;
}

// A disk with all that goes with it.
struct MovingDisk {
  Disk disk;
  double last_contact;
  std::uint32_t thermal_hits;
};

inline MovingDisk moving_disk(const State& state, std::size_t i) {
  const DiskId id = state.disks.id[i];
  return {disk_at(state.disks, i), last_contact_of(state, id), thermal_hits_of(state, id)};
}

// All of it but the disk itself.
inline void take_what_goes_along(State& state, const MovingDisk& moving) {
  take_thermal_hits(state, moving.disk.id, moving.thermal_hits);
  if (moving.disk.id < state.last_contact.size()) state.last_contact[moving.disk.id] = moving.last_contact;
}

inline void take_in(State& state, const MovingDisk& moving, DiskColumns columns) {
  push_back(state.disks, moving.disk, columns);
  take_what_goes_along(state, moving);
}

// Room for n disks in all.
inline void reserve(Disks& d, std::size_t n, DiskColumns columns) {
  for (std::vector<double>* column : {&d.x, &d.y, &d.vx, &d.vy}) column->reserve(n);
  d.id.reserve(n);
  if (columns.radius) d.radius.reserve(n);
  if (columns.mass) d.mass.reserve(n);
  if (columns.spin) d.spin.reserve(n);
}

// The same, and for a few more where that is not there: numbers of disks that go up and down a little do not move the
// columns each time, and columns do not become twice as long, as push_back makes them.
inline void reserve_amply(Disks& d, std::size_t n, DiskColumns columns) {
  const auto amply = [n](auto& column) {
    if (n > column.capacity()) column.reserve(n + n / 64);
  };
  for (std::vector<double>* column : {&d.x, &d.y, &d.vx, &d.vy}) amply(*column);
  amply(d.id);
  if (columns.radius) amply(d.radius);
  if (columns.mass) amply(d.mass);
  if (columns.spin) amply(d.spin);
}

// Without a disk, but with what all share.
inline Disks no_disks_like(const Disks& d) {
  Disks none;
  none.common_radius = d.common_radius;
  none.common_mass = d.common_mass;
  none.inertia = d.inertia;
  return none;
}

// Only the first n disks stay.
inline void truncate(Disks& d, std::size_t n) {
  for (std::vector<double>* column : {&d.x, &d.y, &d.vx, &d.vy, &d.radius, &d.mass, &d.spin}) {
    if (!column->empty()) column->resize(n);
  }
  d.id.resize(n);
}

}  // namespace carom
