// Rank 0 running a scene alone if slabs are not possible: it has all disks, and the others wait for its results.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_start.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

class LoneRank {
 public:
  LoneRank(const Scene& scene, const Threads& threads, Ranks& ranks)
      : scene_(scene), threads_(threads), ranks_(ranks) {}

  // Takes the disks of all ranks, which have these columns. Collective, as are step() and end().
  void begin(DiskColumns columns, State& state);
  // True between begin() and end(), on every rank.
  bool runs() const { return runs_; }
  // Runs a window. state gets everything except disks; an error of the physics is thrown on every rank.
  void step(State& state);
  // As the functions of an engine.
  void forget_paths();
  void release_memory() {
    if (engine_) engine_->release_memory();
  }
  // Moves the disks back to the state of rank 0; all ranks learn the disks' columns and number.
  void end(State& state, DiskColumns& columns, Count& disks);

  // On rank 0 the state with all disks; on the others `here`, which has none.
  const State& state(const State& here) const { return engine_ ? engine_->state() : here; }
  double disks_at(double t, const State& here, Disks& out) const;
  double fastest_within() const { return engine_ ? engine_->fastest_within() : 0.0; }
  std::vector<DiskContact> contacts() const;
  const PhaseTimes& phase_times() const;
  std::vector<std::string> take_warnings();

 private:
  Scene scene_;
  Threads threads_;
  Ranks& ranks_;
  PhaseTimes no_times_;
  bool runs_ = false;
  bool keeps_paths_ = true;
  std::unique_ptr<Engine> engine_;  // on rank 0
  std::vector<std::string> warnings_;
};

// This rank's part of an engine of which rank 0 has all disks from start to end; it warns of that, with start.alone.
// part and start: as for make_slab_part.
std::unique_ptr<Engine> make_lone_part(const Scene& scene, State part, const SlabStart& start, const Threads& threads,
                                       Ranks& ranks);

}  // namespace carom
