// The scenes of the speed-accuracy chart, each with what is measured in it and for how long.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom::chart {

// The quantity of a scene's third error.
enum class Figure {
  pressure,  // from the virial
  cooling,   // 1 / tau of Haff's law, (sqrt(E0 / E) - 1) / t
  spread     // mean square displacement over 4 D t
};

struct ChartScene {
  std::string name;      // in chart.csv
  std::string title;     // above its panel
  std::string text;      // TOML without [run]
  double melting = 0.0;  // duration of a run as an elastic gas before anything is measured
  double flight = 0.0;   // time at which paths are compared: about two mean free times, lambda t < 6
  double length = 0.0;   // duration over which rates are taken: about 25 mean free times
  double longest_step = 0.0;
  Figure figure = Figure::pressure;
  bool keeps_energy = true;
  bool keeps_momentum = true;
  // For a user's own scene (chart_own.hpp): it starts as it says, without melting.
  std::shared_ptr<const Scene> own{};
  bool same_start = false;  // the start is the same for every seed: one run is enough
  double own_step = 0.0;    // an additional step to run; 0: none
  double unit = 1.0;        // unit of time in costs for Brownian motion: diameter^2 / D
};

const std::vector<ChartScene>& chart_scenes();

// The gas at packing fraction 0.5 with this number of disks, for the cost against N.
ChartScene fluid_of(std::size_t disks);

// The scene with a method, step and end; its initial state is made by start_state.
Scene scene_of(const ChartScene& scene, std::uint64_t seed, Method method, double dt, double t_end);

}  // namespace carom::chart
