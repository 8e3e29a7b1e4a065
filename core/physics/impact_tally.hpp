// What the impacts and supports of one step add to the counters. The sums are exact, so parts of a step may be tallied
// separately, in any order, and then added.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/exact_sum.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/disks/state.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/resolve.hpp"
#include "core/physics/support_solver.hpp"

namespace carom {

struct ImpactTally {
  Count collisions = 0;
  Count wall_collisions = 0;        // with sides and obstacles
  Count loads = 0, wall_loads = 0;  // loaded supports (resting.hpp): no collisions, but their impulses count
  Count inaccurate = 0;             // of `collisions`, see PairImpact
  Count inaccurate_at_walls = 0;    // of `wall_collisions`
  ExactSum virial;
  std::array<ExactSum, 4> wall_impulse;
  std::vector<ExactSum> side_energy;  // energy that each side gave; empty if none did
  std::vector<ExactSum> pushes;       // of moving inner walls: work, momentum along x, along y; empty if none pushed
  std::vector<ExactSum> shear;        // in a sheared box: shear_virial and shear_work of PairImpact; else empty
  std::vector<ExactSum>
      absence;       // one sum: of the rest of the window for each disk that a sink took; empty if none did
  SinkCounts taken;  // how many each sink took

  // partner: the second disk's id, or a wall_partner.
  void add(DiskId partner, const Impact& impact) {
    if (const auto* const pair = std::get_if<PairImpact>(&impact)) return add_pair(*pair);
    add_wall(partner, std::get<WallImpact>(impact));
  }

  // A disk and a side or an obstacle.
  void add_wall(DiskId partner, const WallImpact& impact) {
    if (!impact.happened) return add_crossing(impact.energy);
    inaccurate_at_walls += impact.inaccurate ? 1 : 0;
    ++wall_collisions;
    if (is_obstacle(partner)) {
      if (impact.pushed) [[unlikely]]
        add_push(impact.energy, impact.momentum.x, impact.momentum.y);
      return;
    }
    wall_impulse[static_cast<std::size_t>(wall_side(partner))].add(impact.impulse);
    if (impact.energy != 0.0) add_energy(wall_side(partner), impact.energy);
  }

  // Two disks. may_shear: false if the box is not sheared.
  template <bool may_shear = true>
  void add_pair(const PairImpact& impact) {
    if constexpr (!may_shear) {
      if (!impact.happened) return;
    } else if (!impact.happened) {
      return add_crossing(impact.shear_work);
    }
    inaccurate += impact.inaccurate ? 1 : 0;
    add_collision(impact.virial);
    if constexpr (may_shear) {
      if (impact.sheared) add_shear(impact.shear_virial, impact.shear_work);
    }
  }

  // No collision, but disks may have crossed the bottom or the top of a sheared box.
  void add_crossing(double work) {
    if (work != 0.0) [[unlikely]]
      add_shear(0.0, work);
  }

  void add_shear(double its_virial, double work) {
    shear.resize(2);
    shear[0].add(its_virial);
    shear[1].add(work);
  }

  // Collisions in a sheared box with no side between the disks: the shear does no work.
  void add_shears(std::span<const double> virials) {
    if (virials.empty()) return;
    shear.resize(2);
    shear[0].add(virials);
  }

  void add_energy(Side side, double given) {
    side_energy.resize(all_sides.size());
    side_energy[static_cast<std::size_t>(side)].add(given);
  }

  void add_push(double work, double along_x, double along_y) {
    pushes.resize(3);
    pushes[0].add(work);
    pushes[1].add(along_x);
    pushes[2].add(along_y);
  }

  // A sink took a disk `rest` (time) before the window's end.
  void add_taken(SinkNumber sink, double rest) {
    absence.resize(1);
    absence[0].add(rest);
    count_taken(taken, sink);
  }

  // A collision of two disks.
  void add_collision(double its_virial) {
    ++collisions;
    virial.add(its_virial);
  }

  // Several collisions at once, which is faster.
  void add_collisions(std::span<const double> virials) {
    collisions += static_cast<Count>(virials.size());
    virial.add(virials);
  }

  // borne: what a support bore in this round of the step (borne() of support_solver.hpp). A moving wall does work by
  // it.
  void add_load(DiskId partner, const Support& s, double borne, const Domain& box) {
    if (is_wall(partner)) {
      ++wall_loads;
      if (is_obstacle(partner)) {
        if ((*box.obstacles)[obstacle_of(partner)].moves) add_push(borne * s.wall_speed, -borne * s.nx, -borne * s.ny);
        return;
      }
      const Side side = wall_side(partner);
      wall_impulse[static_cast<std::size_t>(side)].add(borne);
      if (box.moves(side)) add_energy(side, borne * box.place(side).speed);
    } else {
      ++loads;
      virial.add(borne);
    }
  }

  void add(const ImpactTally& other) {
    collisions += other.collisions;
    inaccurate += other.inaccurate;
    inaccurate_at_walls += other.inaccurate_at_walls;
    wall_collisions += other.wall_collisions;
    loads += other.loads;
    wall_loads += other.wall_loads;
    if (other.collisions + other.loads > 0) virial.add(other.virial);
    if (other.wall_collisions + other.wall_loads > 0) {
      for (std::size_t k = 0; k < wall_impulse.size(); ++k) wall_impulse[k].add(other.wall_impulse[k]);
    }
    add_each(other.side_energy, side_energy);
    add_each(other.pushes, pushes);
    add_each(other.shear, shear);
    add_each(other.absence, absence);
    carom::add(taken, other.taken);
  }

  Count all_inaccurate() const { return inaccurate + inaccurate_at_walls; }

  // Adds the sums to the counters; the only rounding of a step.
  void count_into(Counters& counters) const {
    counters.collisions += collisions;
    counters.wall_collisions += wall_collisions;
    if (!shear.empty()) {
      counters.shear_virial += shear[0].value();
      counters.shear_work += shear[1].value();
    }
    if (collisions + loads > 0) counters.virial += virial.value();
    if (wall_collisions + wall_loads == 0) return;
    for (std::size_t k = 0; k < wall_impulse.size(); ++k) counters.wall_impulse[k] += wall_impulse[k].value();
    for (std::size_t k = 0; k < side_energy.size(); ++k) counters.side_energy[k] += side_energy[k].value();
    if (pushes.empty()) return;
    counters.wall_work += pushes[0].value();
    counters.wall_push[0] += pushes[1].value();
    counters.wall_push[1] += pushes[2].value();
  }

 private:
  // Adds lists of sums that are empty where there was nothing to add.
  static void add_each(const std::vector<ExactSum>& from, std::vector<ExactSum>& to) {
    if (from.empty()) return;
    to.resize(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) to[k].add(from[k]);
  }
};

}  // namespace carom
