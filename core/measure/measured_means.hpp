// What an analysis comes to as single numbers: means of what it has as one value a sample, and the diffusion
// coefficient.
#pragma once

#include <string_view>
#include <vector>

#include "core/measure/analysis.hpp"
#include "core/measure/diffusion_fit.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct MeasuredMean {
  std::string_view name;
  double value = 0.0;  // NaN where there are too few samples
  double error = 0.0;  // its standard error; NaN likewise
};

// Of those among pressure, collision_rate, diffusion, bond_order_local and bond_order_global that the scene asks for,
// in this order: their means over the samples (of the first two weighted by the intervals), with the standard error by
// blocking (blocking_error.hpp).
std::vector<MeasuredMean> measured_means(const AnalysisRecord& record, const Scene& scene);

// The diffusion coefficient that the displacement shows, in a shear flow that along y. Precondition: the scene asks for
// the displacement.
DiffusionFit diffusion_of(const AnalysisRecord& record, const Scene& scene);

}  // namespace carom
