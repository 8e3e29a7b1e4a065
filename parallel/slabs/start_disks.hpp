// The disks of a scene at its start, one by one: each can be made by itself, from its id.
#pragma once

#include <optional>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/size_law.hpp"
#include "core/start/lattice_places.hpp"
#include "parallel/ranks/ranks.hpp"

namespace carom {

// Disks first to last - 1 of a group, by their numbers in it.
struct GroupRange {
  Count first = 0, last = 0;
};

// The extreme sizes of all disks.
struct SizeFacts {
  DiskSize smallest, largest;         // extremes of radius and of mass, each by itself
  std::vector<double> group_largest;  // largest radius of each group
};

// The corrections that turn the velocities and spins drawn for a group into its initial ones.
struct DrawnMotion {
  Vec2 mean;  // is subtracted
  double factor = 1.0, spin_factor = 1.0;
};

// Centres are in the coordinates of the room between sides that move. Every rank can make any disk; the sums over
// groups, in order of id, pass from rank to rank. Precondition: starts_on_slabs(scene).
class StartDisks {
 public:
  // Collective.
  StartDisks(const Scene& scene, Ranks& ranks);

  const SizeFacts& sizes() const { return sizes_; }
  Count disks() const { return disks_; }
  std::size_t groups() const { return scene_.groups.size(); }

  // Makes the lattices. Throws InputError if there is no room for one. Must be called before height, between and
  // place_of.
  void place();

  // The height of the centre of the group's k-th disk; not less than that of the disk before.
  double height(std::size_t group, Count k) const { return lattices_[group]->at(k).y; }
  // The group's disks from height `low` to just below height `high`.
  GroupRange between(std::size_t group, double low, double high) const;

  // Collective: computes the sums over all disks that the velocities need.
  void sum_motions();

  // For a lattice.
  Vec2 place_of(std::size_t group, Count k) const { return lattices_[group]->at(k); }
  DiskSize size_of(std::size_t group, Count k) const;
  // The disk with its velocity and spin; sum_motions() must have been called.
  Disk disk_at(std::size_t group, Count k, Vec2 place) const;
  DiskId first_id(std::size_t group) const { return first_ids_[group]; }

  // The rank's share of a group, if work on all disks is distributed regardless of their places.
  GroupRange share(std::size_t group) const;
  // Calls use(group, k) for the disks of its shares, in order of id.
  template <class Use>
  void for_share(Use&& use) const {
    for (std::size_t g = 0; g < groups(); ++g) {
      const GroupRange range = share(g);
      for (Count k = range.first; k < range.last; ++k) use(g, k);
    }
  }

 private:
  DiskId id_of(std::size_t group, Count k) const { return first_ids_[group] + static_cast<DiskId>(k); }
  Vec2 drawn_velocity(std::size_t group, Count k, double mass) const;
  template <class Sum, class Add>
  void sum_in_order(std::size_t group, Sum& sum, Add&& add);
  void see_sizes();

  const Scene& scene_;
  Ranks& ranks_;
  Count disks_ = 0;
  std::vector<DiskId> first_ids_;
  SizeFacts sizes_;
  std::vector<std::optional<LatticePlaces>> lattices_;
  std::vector<DrawnMotion> motions_;
};

}  // namespace carom
