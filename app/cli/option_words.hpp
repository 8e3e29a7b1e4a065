// The texts given for each option, before they are parsed.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace carom {

// Options that are changes to the scene, and the key that each changes.
struct SceneOption {
  const char* option;
  const char* key;
  const char* value;  // name of the value in --help
  const char* help;
};
inline constexpr std::array<SceneOption, 4> scene_options{{
    {"--method", "run.method", "rollback|pairwise|exact|auto", "method, instead of that of the scene"},
    {"--dt", "run.dt", "X", "time step"},
    {"--t-end", "run.t_end", "T", "simulated time at which the run ends"},
    {"--seed", "seed", "S", "seed of all random numbers"},
}};

inline constexpr std::size_t t_end_option = 2;  // its index

// The texts read by CLI11. They are parsed and checked afterwards, so that all error messages have Carom's form.
struct OptionWords {
  std::string first, second, folder, engine, threads, ranks, frame, walltime, seeds, jobs, emit, accuracy, tolerance,
      fields, times, at, colour, range, size, fps, max_size;
  std::array<std::string, scene_options.size()> scene_values;
  std::vector<std::string> sets, over;
  bool json = false, quiet = false, force = false, strict = false, quick = false, tiny = false, open = false,
       live = false, view = false;
};

}  // namespace carom
