// The sinks of a scene by name.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct SceneSink {
  SinkNumber number;
  std::string name;  // of a side, or of the [[walls]] table, as messages call it: left, walls.2
};

// In order of their numbers.
std::vector<SceneSink> sinks_of(const Scene& scene);

// How many it took so far.
Count taken_by(const SceneSink& sink, const State& state);

}  // namespace carom
