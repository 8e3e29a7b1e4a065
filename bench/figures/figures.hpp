// The figures that speed is promised in, as they were measured, with what was promised.
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

// Each measures its own contenders in one interleaved run and writes a CSV file into the folder.
std::vector<Figure> measure_gas(const std::string& folder);       // phases.csv: a step of G against the copy limit
std::vector<Figure> measure_scaling(const std::string& folder);   // scaling.csv: from 10^4 to 10^7 disks
std::vector<Figure> measure_features(const std::string& folder);  // features.csv: what each feature costs
std::vector<Figure> measure_special();                            // wide radii, the pile
std::vector<Figure> measure_exact(const std::string& folder);     // exact.csv: collisions a second, and the yardstick's
std::vector<Figure> measure_exact_growth(const std::string& folder);  // exact_growth.csv: up to 10^7 disks; minutes
std::vector<Figure> measure_borders(const std::string& folder);  // borders.csv: what regions leave to their borders
std::vector<Figure> measure_memory(const std::string& program, const std::string& scene);

}  // namespace carom::bench
