// The output of carom check, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/run/check_outputs.hpp"
#include "core/scene/scene.hpp"
#include "run/foresight/rank_foresight.hpp"
#include "run/results/json_keys.hpp"

namespace carom {

// A longer growth is not worth waiting for here; seconds.
inline constexpr double longest_growth = 10.0;

struct Findings {
  Count disks = 0;
  double smallest_radius = 0.0, largest_radius = 0.0;
  double smallest_mass = 0.0, largest_mass = 0.0;
  double packing_fraction = 0.0;        // of the disks that move
  double packing_fraction_fixed = 0.0;  // of fixed disks, which count in the scene's box.packing_fraction
  StepForesight steps;
  Population population;
  CollapseForesight collapse;
  std::vector<std::string> troubles;
  OutputForesight outputs;
  double start_seconds = 0.0;   // time to make the initial state
  double growth_seconds = 0.0;  // on one core; above longest_growth the disks were not grown, and no step was tried
  double step_seconds = 0.0;    // for all steps, extrapolated from the first ones; may be infinite
  double memory_bytes = 0.0;
  std::optional<RankForesight> ranks;  // if requested
  std::string stopped;                 // the message of the physics, if it stopped the trial

  double seconds() const { return start_seconds + step_seconds + outputs.seconds(); }
};

std::string check_text(const Scene& scene, const Findings& found, const std::optional<double>& accuracy);
std::string check_json(const Scene& scene, const Findings& found, const std::optional<double>& accuracy);

// The texts of docs/scene.md about the keys of that object.
std::vector<KeyText> check_key_texts();
std::vector<KeyText> check_rank_key_texts();  // of the object `ranks`

}  // namespace carom
