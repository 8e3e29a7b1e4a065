// The chart of one scene as a table to read.
#pragma once

#include <string>

#include "app/chart/chart_result.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// What each method and step costs in a run of the scene to its end, and how wrong it is; which is the cheapest for an
// error.
std::string own_chart_text(const chart::SceneResult& result, const Scene& scene);

}  // namespace carom
