// The base of the two parallel time-stepping methods: disks in cells, and the phases of a step.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state.hpp"
#include "core/physics/step_rules.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/stepping/displaced_disks.hpp"
#include "parallel/stepping/find_contacts.hpp"
#include "parallel/stepping/move_sheared.hpp"
#include "parallel/stepping/resolve_contacts.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

class TimeStepping : public Engine {
 public:
  TimeStepping(const Scene& scene, State initial, const Threads& threads);

  const State& state() const override { return state_; }
  double disks_at(double t, Disks& out) const override;
  std::vector<DiskContact> contacts() const override;
  bool edit(const Edit& edit) override;
  bool visit_near(Vec2 centre, double half_width, double half_height,
                  const std::function<void(std::size_t)>& visit) override;
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override;

 protected:
  // The phases of a step, in its order. Reads -> writes are listed in docs/architecture.md.
  void start_interval(double t, double dt, Count step);  // touching sinks at 0; sources, Brownian velocities
  void kick_if_due();                                    // by the thermostat
  Count parts(double dt);                                // of a step that is too long to be safe
  void sort_if_due();                                    // disks into cells, when they have left them too far
  void drift(double t);                                  // all disks
  void search(const StepRules& rules);                   // touching pairs and wall contacts
  StepFigures resolve(const StepRules& rules);           // impacts, supports, pushing apart, wrapping (pairwise)
  void keep_places();                                    // positions before resolving, for presses_others
  bool presses_others();                                 // in a pile: has resolving pressed disks together?
  void gather(const StepRules& rules);                   // all contacts into lists_.events (rollback)
  void finish_contacts();                                // wraps the disks that contacts moved
  void remove_at_sinks();
  Count all_disks() const { return state_.disks.size(); }
  void forget_speeds() { speed2_known_ = false; }  // after a phase that may have raised a speed

  Scene scene_;
  State state_;
  std::unique_ptr<ObstacleCells> obstacles_;  // of scene_.box
  Executor executor_;
  PhaseTimes times_;
  Validity validity_;
  ContactLists lists_;

 private:
  void sort_now();
  void move_sheared(double t);
  bool may_be_loose(const Edit& edit) const;
  void emit_from_sources(double t, Count step);
  void draw_velocities(double dt, Count step);
  double exact_travel2();
  void remove_gone(Count marked);  // those of gone_

  CellList cells_;
  FoundContacts found_;  // in the last search
  DisplacedDisks displaced_;
  std::vector<unsigned char> gone_;
  bool closed_up_ = false;                 // since the last search, disks marked in gone_ have been removed
  std::vector<double> block_values_;       // scratch, one a block
  ShearedBlocks sheared_;                  // scratch, for a sheared box
  std::vector<std::size_t> class_counts_;  // disks of each size class
  double smallest_radius_ = 0.0;           // 0: not known
  bool smallest_may_be_gone_ = false;      // a program has removed a disk
  double excursion_ = -1.0;                // as furthest_excursion; negative: not known
  double speed2_ = 0.0;                    // no disk's squared speed is larger
  bool speed2_known_ = false;              // false: speed2_ must be computed anew
  bool cells_valid_ = false;               // cells_ belong to the present storage order
  std::size_t strays_ = 0;                 // in the last search
};

}  // namespace carom
