// What a run came to: the JSON object that other programs read, and a short table for people.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/measure/measured_means.hpp"
#include "core/measure/state_sums.hpp"
#include "parallel/slabs/rank_report.hpp"
#include "run/engine/make_engine.hpp"
#include "run/results/json_keys.hpp"

namespace carom {

struct Summary {
  std::string scene;  // file
  std::string title;
  std::string method;
  EngineChoice engine;
  Count particles = 0;  // now
  double time = 0.0;
  Counters counters;
  double wall_s = 0.0, cpu_s = 0.0, step_s = 0.0;
  bool drawn_velocities = false;  // energies, momentum and pressure mean nothing, and are NaN
  bool keeps_momentum = false;    // so that its drift is an error
  double energy_initial = 0.0, energy_final = 0.0;
  double momentum_drift = 0.0;                   // |change of sum m v| over sum |m v|, the larger of start and end
  double max_overlap = 0.0, wall_overlap = 0.0;  // now
  WorstOverlap worst_disks, worst_wall;          // of the whole run
  double mean_disks = 0.0;                       // over the whole run
  double pressure = 0.0;  // mean over the whole run; NaN where the kinetic energy has changed too much to say
  double kinetic_initial = 0.0, kinetic_final = 0.0;  // relative to a shear flow
  double collision_rate = 0.0;                        // per disk per unit time: a collision counts for both disks
  std::string state_hash;
  std::uint64_t seed = 1;
  Domain box;
  bool thermostat = false;
  bool series = false;                                    // series.csv is written
  std::vector<std::pair<std::string, Count>> removed_by;  // each sink, and how many disks it took
  std::vector<MeasuredMean> measured;                     // by the scene's analysis
  Count frames = 0;
  std::vector<std::string> warnings;  // of the physics, in order
  Count resumed = 0;                  // how often it went on from a checkpoint; the times are those of all parts
  std::string resume_with;            // of a run that stopped early: the command that goes on
  PhaseTimes phases;
  std::optional<RankReport> ranks;  // of several
};

// Of all disks, of all ranks.
StateSums sums_of(const Engine& engine, const Scene& scene, const EngineChoice& choice);

// Everything but the times, what an analysis measured, the number of frames and the warnings, which the caller adds.
Summary summarize(const RunStart& start, const Engine& engine, const Scene& scene, const EngineChoice& choice);

// One JSON object with the keys of the table in summary.cpp, in its order (resume_with only of a run that stopped
// early). Numbers in full precision; null for one that is not finite.
std::string json_text(const Summary& summary);

// What docs/scene.md says of each of these keys.
std::vector<KeyText> summary_key_texts();

// A few aligned lines. folder: where the results are, empty if nowhere.
std::string table_text(const Summary& summary, const std::string& folder);

}  // namespace carom
