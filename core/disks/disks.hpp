// The disks as structure of arrays. A column that a scene does not need does not exist.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/types.hpp"

namespace carom {

// n disks; x, y, vx, vy and id always have n entries. radius (mass) has n entries, or is empty when all disks
// share common_radius (common_mass). Storage order is free; id tells which disk an entry is.
struct Disks {
  std::vector<double> x, y;    // centre; length
  std::vector<double> vx, vy;  // length / time
  std::vector<DiskId> id;
  std::vector<double> radius;  // length, > 0
  std::vector<double> mass;    // mass, > 0
  double common_radius = 0.0;  // used when radius is empty
  double common_mass = 0.0;    // used when mass is empty
  std::vector<double> spin;    // angular velocity, counter-clockwise; 1 / time; n entries where disks are rough
  double inertia = 0.0;        // I / (m r^2) of rough disks; 0: smooth ones, which do not spin

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  double radius_of(std::size_t i) const { return radius.empty() ? common_radius : radius[i]; }
  double mass_of(std::size_t i) const { return mass.empty() ? common_mass : mass[i]; }
  bool spins() const { return inertia > 0.0; }
  double spin_of(std::size_t i) const { return spin.empty() ? 0.0 : spin[i]; }
};

// One disk on its own, as sources emit it and tests write it down.
struct Disk {
  double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0;
  double radius = 0.0, mass = 0.0;
  DiskId id = 0;
  double spin = 0.0;
};

inline Disk disk_at(const Disks& d, std::size_t i) {
  return {d.x[i], d.y[i], d.vx[i], d.vy[i], d.radius_of(i), d.mass_of(i), d.id[i], d.spin_of(i)};
}

// Appends a disk. A common radius or mass that the newcomer does not share becomes a column.
void append(Disks& disks, const Disk& disk);

// Removes the entries i with gone[i] != 0; the others close up and keep their order. gone has n entries.
// Returns how many were removed.
std::size_t remove_marked(Disks& disks, const std::vector<unsigned char>& gone);

// Removes entry i; the last disk takes its place. Precondition: i < size.
void take_out(Disks& disks, std::size_t i);

// Largest and smallest radius present; 0 without disks.
double largest_radius(const Disks& disks);
double smallest_radius(const Disks& disks);

// Storage indices in ascending order of id.
std::vector<std::size_t> by_id(const Disks& disks);

}  // namespace carom
