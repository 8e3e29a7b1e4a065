// The chart of one scene as a table to read.
#pragma once

#include <string>

#include "app/chart/chart_result.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The cost and the error of each method and step in a run of the scene to its end, and the cheapest one for an error.
std::string own_chart_text(const chart::SceneResult& result, const Scene& scene);

}  // namespace carom
