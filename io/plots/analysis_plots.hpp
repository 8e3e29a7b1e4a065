// A plot of each quantity that a run measured.
#pragma once

#include <string>

#include "core/measure/analysis.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Draws pair_correlation.svg, displacement.svg and so on into the folder, as far as the scene has them. Returns false,
// and draws nothing, if gnuplot is not installed. Throws RunError if gnuplot fails or a file cannot be written.
bool draw_analysis(const std::string& folder, const Scene& scene, const AnalysisRecord& record);

}  // namespace carom
