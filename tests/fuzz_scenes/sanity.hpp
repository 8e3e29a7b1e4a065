// Conditions that must hold in any run of any scene: numbers are finite, disks stay in the box, and disks, momentum and
// energy are conserved, unless a warning says otherwise.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/measure/invariants.hpp"
#include "core/scene/scene.hpp"

namespace carom::fuzz {

class Sanity {
 public:
  Sanity(const Scene& scene, const State& start);

  // To be called after each step, with the warnings raised in it.
  void look(const State& state, const std::string& warnings);
  // Compares all pairs of disks at a time within a window of exact: none may overlap, independently of the engines' own
  // checks.
  void look_within(const Disks& disks, double time);

  // The first fault found; empty if there is none.
  const std::string& fault() const { return fault_; }

 private:
  void blame(const State& state, const std::string& what);
  // A fault that a warning still has to report.
  struct Unsaid {
    std::string what;
    int steps = 0;  // steps since it was found
  };
  void say_later(const State& state, Unsaid& unsaid, const std::string& found);
  void look_at_places(const State& state);
  void look_at_overlaps(const State& state);
  void look_at_counts(const State& state);
  void look_at_sources(const State& state, double before);
  void look_at_energy(const State& state);
  void look_at_momentum(const State& state);

  const Scene& scene_;
  std::size_t disks_ = 0;  // at the start
  Counters before_;
  double time_ = 0.0;
  std::vector<Obstacle> obstacles_;
  Energy energy_;      // at the start
  Momentum momentum_;  // at the start
  double largest_energy_ = 0.0, largest_momentum_ = 0.0;
  Unsaid unsaid_place_, unsaid_overlap_;
  std::string warnings_, fault_;
};

}  // namespace carom::fuzz
