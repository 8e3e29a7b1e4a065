// The results of a run: as a JSON object for other programs, and as a short table for people.
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
  Count particles = 0;  // at present
  double time = 0.0;
  Counters counters;
  double wall_s = 0.0, cpu_s = 0.0, step_s = 0.0;
  bool drawn_velocities = false;  // energies, momentum and pressure have no meaning, and are NaN
  bool keeps_momentum = false;    // so its drift is an error
  double energy_initial = 0.0, energy_final = 0.0;
  double momentum_drift = 0.0;                   // |change of sum m v| over sum |m v|, the larger of start and end
  double max_overlap = 0.0, wall_overlap = 0.0;  // at present
  WorstOverlap worst_disks, worst_wall;          // of the whole run
  double mean_disks = 0.0;                       // over the whole run
  double pressure = 0.0;  // mean over the whole run; NaN if the kinetic energy has changed too much for one
  double kinetic_initial = 0.0, kinetic_final = 0.0;  // relative to a shear flow
  double collision_rate = 0.0;                        // per disk and unit time: a collision counts for both disks
  std::string state_hash;
  std::uint64_t seed = 1;
  Domain box;
  bool thermostat = false;
  bool series = false;                                    // is series.csv written?
  std::vector<std::pair<std::string, Count>> removed_by;  // each sink, and the number of disks that it took
  std::vector<MeasuredMean> measured;                     // by the scene's analysis
  Count frames = 0;
  std::vector<std::string> warnings;  // of the physics, in order
  Count resumed = 0;                  // how often it was continued from a checkpoint; times are sums over all parts
  std::string resume_with;            // of a run that stopped early: the command that continues it
  PhaseTimes phases;
  std::optional<RankReport> ranks;  // with several ranks
};

// Over all disks of all ranks.
StateSums sums_of(const Engine& engine, const Scene& scene, const EngineChoice& choice);

// Everything except the times, the results of an analysis, the number of frames and the warnings, which the caller
// adds.
Summary summarize(const RunStart& start, const Engine& engine, const Scene& scene, const EngineChoice& choice);

// One JSON object with the keys of the table in summary.cpp, in its order (resume_with only for a run that stopped
// early). Numbers have full precision; null for one that is not finite.
std::string json_text(const Summary& summary);

// The texts of docs/scene.md about these keys.
std::vector<KeyText> summary_key_texts();
std::vector<KeyText> traffic_key_texts();  // of the object `traffic`

// A few aligned lines. folder: of the results, empty if there are none.
std::string table_text(const Summary& summary, const std::string& folder);

}  // namespace carom
