// The base of the two time-stepping references: the state, and the phases that PairwiseMethod and RollbackMethod
// (core/step) share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state.hpp"
#include "core/physics/contact_event.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"
#include "core/step/validity.hpp"

namespace carom {

class ReferenceEngine : public Engine {
 public:
  ReferenceEngine(const Scene& scene, State initial);

  const State& state() const override { return state_; }
  double disks_at(double t, Disks& out) const override;
  std::vector<DiskContact> contacts() const override;
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override;

 protected:
  // Removes disks that touch a sink at the start of the run; lets sources emit what is due at time t; draws Brownian
  // velocities for an interval of length dt, whose number is `step`; and removes the disks that cross a sink within it.
  void start_interval(double t, double dt, Count step);
  void kick_if_due();  // by the thermostat
  // Number of parts into which an interval of length dt must be split at the present speeds; warns if that is above 1.
  Count parts(double dt);
  void sort_if_due() {}  // the reference does not sort its disks
  void drift(double t);  // all disks
  void wrap_all();
  void remove_at_sinks();
  Count all_disks() const { return state_.disks.size(); }

  Scene scene_;
  State state_;
  std::unique_ptr<ObstacleCells> obstacles_;  // of scene_.box
  PhaseTimes times_;
  Validity validity_;
  std::vector<ContactEvent> events_;  // of the last search
};

}  // namespace carom
