// One rank's part of `exact` on slabs: its windows and its disks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/step/engine.hpp"
#include "core/step/validity.hpp"
#include "core/step/window_length.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/window_run.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/exact_ghosts.hpp"
#include "parallel/slabs/lone_rank.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "parallel/slabs/slab_start.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// The disks of a window in its storage order; ghosts: an entry for each, 1 for ghosts.
struct WindowDisks {
  Disks disks;
  std::vector<unsigned char> ghosts;
};

// See make_slab_exact_part (slab_exact.hpp). Preconditions: slabs support the scene, and there are several ranks.
class SlabExact final : public Engine, public InSlabs {
 public:
  SlabExact(const Scene& scene, State part, const SlabStart& start, const Threads& threads, Ranks& ranks);

  void step() override;
  const State& state() const override;
  const State& progress() const override { return state_; }
  double disks_at(double t, Disks& out) const override;
  double fastest_within() const override;
  std::vector<DiskContact> contacts() const override;
  void forget_paths() override {
    windows_.window().keeps_paths = false;
    lone_.forget_paths();
  }
  void release_memory() override;
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override;
  const SlabCut* slab_cut() const override;
  Count own_disks() const override {
    return lone_.runs() ? lone_.state(state_).disks.size() : ghosts_.own_among(state_.disks.size());
  }
  Count ghosts() const override { return lone_.runs() ? 0 : seen_ghosts_; }

 private:
  std::function<bool(std::uint32_t)> owned() const;
  void start_window();
  void emit();
  bool remove_gone();
  void kick();
  void step_alone();
  void run_alone(int windows);
  SpeedSummary speeds_of_all() const;
  void warn_of_thin_slabs();
  bool run_window(WindowPlan& plan, const SpeedSummary& speeds);
  bool prepare_lists(const WindowPlan& plan, double fastest);
  bool share_out(const WindowPlan& plan, double fastest);
  Approach approach_in(const WindowPlan& plan, double fastest) const;
  std::optional<double> ghost_depth(const WindowPlan& plan, double fastest) const;
  void finish(const WindowPlan& plan);

  Scene scene_;
  State state_;  // with ghosts
  std::unique_ptr<ObstacleCells> obstacles_;
  Ranks& ranks_;
  Executor executor_;
  SlabStart start_;
  SlabCut cut_;
  Count seen_ghosts_ = 0;  // in the last window
  double left_ = 0.0;      // no disk has left its slab by more; length
  Validity validity_;
  PhaseTimes times_;
  ExactGhosts ghosts_;
  WindowRun windows_;
  LoneRank lone_;
  int alone_ = 0;  // windows that one rank still has to run
  const double first_zone_;
  double zone_;             // mean spacings
  double approach_;         // share of the largest flight by which other ranks' disks are assumed to come nearer
  bool thin_told_ = false;  // has it been reported that slabs would be too thin?
  const bool takes_;        // are there sinks?
  std::optional<WindowPlan> logged_;
  std::vector<unsigned char> gone_;
  WindowDisks at_start_;  // if disks left through sinks in the last window; else empty
  std::vector<std::string> warnings_;
  mutable std::optional<State> own_;  // if it was asked for after the last step
};

}  // namespace carom
