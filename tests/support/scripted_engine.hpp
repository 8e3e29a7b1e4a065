// An engine whose steps are defined by a test. It knows no times within a step.
#pragma once

#include <string>
#include <vector>

#include "core/base/phase_times.hpp"
#include "core/disks/disk_contact.hpp"
#include "core/disks/state.hpp"
#include "core/step/engine.hpp"

namespace carom::test {

class ScriptedEngine : public Engine {
 public:
  const State& state() const override { return state_; }
  double disks_at(double /*t*/, Disks& out) const override {
    out = state_.disks;
    return state_.time;
  }
  std::vector<DiskContact> contacts() const override { return {}; }
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override { return {}; }

 protected:
  State state_;

 private:
  PhaseTimes times_;
};

}  // namespace carom::test
