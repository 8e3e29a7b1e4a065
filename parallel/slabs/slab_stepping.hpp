// The phases of a step of `pairwise` on one of several ranks, each with a slab of the box.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/physics/step_rules.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"
#include "core/step/validity.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/border_contacts.hpp"
#include "parallel/slabs/border_rounds.hpp"
#include "parallel/slabs/border_search.hpp"
#include "parallel/slabs/ghost_disks.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "parallel/slabs/slab_start.hpp"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/stepping/displaced_disks.hpp"
#include "parallel/stepping/find_contacts.hpp"
#include "parallel/stepping/move_sheared.hpp"
#include "parallel/stepping/resolve_contacts.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// The disks of state() are the rank's own; all else in it is the same on all ranks. step() is collective. Used by
// PairwiseMethod.
class SlabStepping : public Engine, public InSlabs {
 public:
  // part: with the disks in the rank's slab. start: of all disks, the same on all ranks.
  SlabStepping(const Scene& scene, State part, const SlabStart& start, const Threads& threads, Ranks& ranks);

  const State& state() const override { return state_; }
  double disks_at(double t, Disks& out) const override;
  std::vector<DiskContact> contacts() const override;
  const SlabCut* slab_cut() const override { return &cut_; }
  Count own_disks() const override { return state_.disks.size(); }
  Count ghosts() const override { return ghosts_.count(); }
  void release_memory() override;
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override { return validity_.take_warnings(); }

 protected:
  // As in TimeStepping, for scenes that slabs support (slab_pairwise.hpp).
  void start_interval(double t, double dt, Count step);
  void kick_if_due();
  Count parts(double dt);
  void sort_if_due();
  void drift(double t);
  void search(const StepRules& rules);
  StepFigures resolve(const StepRules& rules);
  void keep_places() {}  // search() does it, since it may sort the disks anew
  bool presses_others();
  void remove_at_sinks();
  Count all_disks() const { return disks_; }

  Scene scene_;
  State state_;
  Validity validity_;
  std::unique_ptr<ObstacleCells> obstacles_;  // of scene_.box

 private:
  std::vector<DiskContact> contacts_found() const;
  void make_cells(const std::vector<std::size_t>& counts);
  void emit_from_sources(double t, Count step);
  void take_newcomers(const Disks& newcomers);
  double move_sheared(double t);
  void sort_now();
  void cut_anew_if_uneven();
  void migrate();
  bool migrate_to_neighbours();
  bool take_in(const Bytes& migrants);
  void find_near_borders();
  void see_neighbours();
  double resolve_here(const StepRules& rules, ImpactTally& tally);
  double resolve_alone_at_border(const StepRules& rules, ImpactTally& tally);
  double settle_here(const StepRules& rules, ImpactTally& tally);
  bool presses_disks_of_others(double excursion, double slack);
  bool is_pressed_by(const std::vector<Disk>& disks, double slack);
  void drop_ghosts();
  double smallest_of_all() const;
  void remove_gone();
  void keep_contacts_of_those_that_stay();
  void agree(ImpactTally& tally, double speed2);

  Ranks& ranks_;
  Executor executor_;
  PhaseTimes times_;
  SlabCut cut_;
  Slab slab_;
  DiskColumns columns_;
  double smallest_radius_ = 0.0, largest_radius_ = 0.0;  // of all disks, also those that sources may bring
  CellList cells_;                                       // of the slab
  FoundContacts found_;                                  // in the last search
  ContactLists lists_;
  GhostDisks ghosts_;
  BorderContacts border_contacts_;
  BorderRounds border_rounds_;
  DisplacedDisks displaced_;
  std::vector<std::pair<DiskId, DiskId>> crossing_ids_;  // in the last search: own disk, ghost
  std::vector<DiskContact> contacts_kept_;               // of that search, if disks have left since
  bool closed_up_ = false;                               // have disks left since?
  // The following are the same on all ranks between two steps.
  Count disks_ = 0;         // of all ranks
  double excursion_ = 0.0;  // largest distance of any rank's disk from its slab; length
  double speed2_ = 0.0;     // no disk's squared speed is larger
  bool speed2_known_ = false;
  bool sort_due_ = true;
  std::size_t strays_ = 0;  // in the last search, on this rank
  // Scratch.
  std::vector<std::uint32_t> near_;
  SeenBeyond seen_;
  std::vector<unsigned char> gone_;
  SinkCounts taken_;  // by sinks, of the disks marked in gone_
  std::vector<double> block_values_;
  ShearedBlocks sheared_;
};

}  // namespace carom
