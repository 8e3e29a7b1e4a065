// The single numbers of an analysis: means of its series, and the diffusion coefficient.
#pragma once

#include <string_view>
#include <vector>

#include "core/measure/analysis.hpp"
#include "core/measure/diffusion_fit.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct MeasuredMean {
  std::string_view name;
  double value = 0.0;                                      // NaN if there is nothing to measure
  double error = 0.0;                                      // its standard error; NaN likewise, or with too few samples
  std::string_view missing = "there are too few samples";  // the reason why the value is NaN
};

// Means over the samples, in this order, of pressure, collision_rate, diffusion, bond_order_local and
// bond_order_global, as far as the scene asks for them; the first two are weighted by the intervals. Standard errors
// are by blocking (blocking_error.hpp).
std::vector<MeasuredMean> measured_means(const AnalysisRecord& record, const Scene& scene);

// The diffusion coefficient; in a shear flow, of the motion along y. Precondition: the scene asks for the displacement.
DiffusionFit diffusion_of(const AnalysisRecord& record, const Scene& scene);

}  // namespace carom
