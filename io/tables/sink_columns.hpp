// How many disks each sink of a scene took, as tables tell it.
#pragma once

#include <string>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "io/tables/column_text.hpp"

namespace carom {

// A column's name is this one's, an underscore, and the sink's.
inline constexpr ColumnText taken_column{"removed_by", "", "disks that a sink has taken, since the start"};

struct SceneSink {
  SinkNumber number;
  std::string name;  // of a side, or of the [[walls]] table, as messages call it: left, walls.2
};

// In order of their numbers.
std::vector<SceneSink> sinks_of(const Scene& scene);

// How many it took so far.
Count taken_by(const SceneSink& sink, const State& state);

}  // namespace carom
