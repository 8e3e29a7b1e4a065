// The measured figures for which a speed is promised, with the promise.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace carom::bench {

struct Figure {
  std::string name;
  double value;
  std::string unit;  // "" for a ratio
  std::optional<double> at_most, at_least;
};

// Each function measures its own contenders in one interleaved run and writes a CSV file into the folder.
std::vector<Figure> measure_gas(const std::string& folder);       // phases.csv: a step of G against the copy limit
std::vector<Figure> measure_scaling(const std::string& folder);   // scaling.csv: from 10^4 to 10^7 disks
std::vector<Figure> measure_features(const std::string& folder);  // features.csv: the cost of each feature
std::vector<Figure> measure_special();                            // wide radii, the pile
std::vector<Figure> measure_exact(const std::string& folder);     // exact.csv: collisions per second; the yardstick's
std::vector<Figure> measure_exact_growth(const std::string& folder);  // exact_growth.csv: up to 10^7 disks; minutes
std::vector<Figure> measure_borders(const std::string& folder);  // borders.csv: work left to the borders of regions
std::vector<Figure> measure_memory(const std::string& program, const std::string& scene);

}  // namespace carom::bench
