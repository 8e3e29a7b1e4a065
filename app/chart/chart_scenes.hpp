// The scenes of the speed-accuracy chart, each with what is measured in it and for how long.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom::chart {

// What the third error of a scene is about.
enum class Figure {
  pressure,  // from the virial
  cooling,   // 1 / tau of Haff's law, (sqrt(E0 / E) - 1) / t
  spread     // mean square displacement over 4 D t
};

struct ChartScene {
  std::string name;      // in chart.csv
  std::string title;     // over its panel
  std::string text;      // TOML without [run]
  double melting = 0.0;  // time for which an elastic gas of these disks is run before anything is measured
  double flight = 0.0;   // time after which paths are compared: about two mean free times, lambda t < 6
  double length = 0.0;   // time over which rates are taken: about 25 mean free times
  double longest_step = 0.0;
  Figure figure = Figure::pressure;
  bool keeps_energy = true;
  bool keeps_momentum = true;
  // Of a scene of the user's own (chart_own.hpp): it starts as it says, not melted.
  std::shared_ptr<const Scene> own{};
  bool same_start = false;  // the same for every seed: one run is enough
  double own_step = 0.0;    // a step to run besides; 0: none
  double unit = 1.0;        // time that costs are given in where there is Brownian motion: diameter^2 / D
};

const std::vector<ChartScene>& chart_scenes();

// The gas at packing fraction 0.5 with so many disks, for the cost against N.
ChartScene fluid_of(std::size_t disks);

// The scene with a method, step and end; what it starts from is made by start_state.
Scene scene_of(const ChartScene& scene, std::uint64_t seed, Method method, double dt, double t_end);

}  // namespace carom::chart
