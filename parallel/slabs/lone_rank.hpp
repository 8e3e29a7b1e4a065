// Rank 0 running a scene alone, where slabs do not do: it has all disks, and the others wait for what comes of them.
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
  // Between begin() and end(), on every rank.
  bool runs() const { return runs_; }
  // A window. state gets all that is not of disks; an error of the physics is every rank's.
  void step(State& state);
  // As of an engine.
  void forget_paths();
  void release_memory() {
    if (engine_) engine_->release_memory();
  }
  // The disks are in the state of rank 0 again; all ranks learn which columns they have, and how many they are.
  void end(State& state, DiskColumns& columns, Count& disks);

  // Of rank 0, with all disks; the others give back `here`, which has none.
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

// This rank's part of an engine of which rank 0 has all disks from the start to the end; it warns of that, with
// start.alone. part and start: as of make_slab_part.
std::unique_ptr<Engine> make_lone_part(const Scene& scene, State part, const SlabStart& start, const Threads& threads,
                                       Ranks& ranks);

}  // namespace carom
