// The initial places of a group's disks on a lattice, disk by disk.
#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/start/lattice.hpp"

namespace carom {

class LatticePlaces {
 public:
  // radius: the largest of the group's disks. Throws InputError, with file, line and key, if they do not fit.
  // Precondition: the group is on a lattice and has disks.
  LatticePlaces(const Scene& scene, std::size_t group, double radius);

  // The centre of the group's k-th disk, k < count; not lower than that of the disk before.
  Vec2 at(Count k) const;

 private:
  void fill_circle(const Scene& scene, std::size_t group);

  Domain box_;  // filled by the lattice
  Vec2 origin_;
  double radius_;
  Count count_;
  Lattice lattice_;
  std::vector<Vec2> sites_;  // of a lattice in a circle, relative to origin_
};

}  // namespace carom
