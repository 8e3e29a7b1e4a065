// The runs of a sweep: every combination of values and seeds.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command_line.hpp"

namespace carom {

// One key of the scene and its values, as written in TOML.
struct SweepAxis {
  std::string key;
  std::vector<std::string> values;
};

// "physics.restitution=0.5:1.0:11" (11 values from 0.5 to 1.0, ends included) or "run.method=pairwise,exact". Throws
// InputError for anything else.
SweepAxis parse_sweep_axis(const std::string& text);

struct SweepRun {
  std::string name;                 // of its folder: 0001, 0002, ...
  std::vector<Override> overrides;  // those of the command line, then one for each axis, then the seed
  std::size_t scene = 0;            // fingerprint of its scene (scene_of_run.hpp)
};

// Seeds vary fastest, then the last axis. The first seed is the scene's own. Throws InputError for more than a million
// runs, and for seeds beyond 64 bits.
std::vector<SweepRun> sweep_runs(const SceneChanges& changes, const std::vector<SweepAxis>& axes, std::uint64_t seed,
                                 int seeds);

// Everything that distinguishes one sweep from another, as text: the runs with what they change, and the scene.
std::string sweep_identity(const std::string& scene_text, const std::vector<SweepRun>& runs);

// Extends a sweep: the runs that the sweep with this identity already has keep its names, so that none is run again;
// the others are numbered on from there. Returns what does not match, empty if all does.
std::string take_names(const std::string& identity, const std::string& scene_text, std::vector<SweepRun>& runs);

}  // namespace carom
