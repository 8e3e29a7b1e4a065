// The sinks of a scene and their names.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct SceneSink {
  SinkNumber number;
  std::string name;  // of the side, or of the [[walls]] table: left, walls.2
};

// In the order of their numbers.
std::vector<SceneSink> sinks_of(const Scene& scene);

// The number of disks that the sink has taken so far.
Count taken_by(const SceneSink& sink, const State& state);

}  // namespace carom
