// Variants of scene G with a single feature each, to measure its cost.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace carom::bench {

// The parts of a scene's text in which a feature may differ from the plain gas. Features change little, so that the gas
// remains the same and only the cost of modelling differs.
struct GasFeature {
  std::string name;   // without spaces
  std::string sides;  // lines of [box]
  std::string physics;
  std::string velocities = "velocities = { maxwell = 1.0 }\n";
  std::string radius = "0.5";
  std::string mass = "1.0";
  std::string obstacles = {};  // separate tables; the gas then leaves a strip of the box free
};

// "plain" comes first.
std::vector<GasFeature> gas_features();

// The text of scene G with count disks and a feature, up to its [run]. Throws std::invalid_argument for an unknown
// name.
std::string gas_text(std::size_t count, const std::string& feature);

}  // namespace carom::bench
