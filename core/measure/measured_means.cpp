#include "core/measure/measured_means.hpp"

#include "core/base/blocking_error.hpp"
#include "core/base/sample_mean.hpp"

namespace carom {

DiffusionFit diffusion_of(const AnalysisRecord& record, const Scene& scene) {
  return fit_diffusion(record.series.time, record.series.displacement, scene.box.shear.acts() ? 1.0 : 2.0);
}

std::vector<MeasuredMean> measured_means(const AnalysisRecord& record, const Scene& scene) {
  const SampleSeries& series = record.series;
  std::vector<MeasuredMean> means;
  const auto add = [&](std::string_view name, const std::vector<double>& values,
                       const std::vector<double>& weights = {}) {
    means.push_back({name, sample_mean(values, weights).mean, blocking_error(values, weights)});
  };
  const AnalysisPlan& plan = scene.analysis;
  if (plan.wants(Quantity::pressure)) add("pressure", series.pressure, series.interval);
  if (plan.wants(Quantity::collision_rate)) add("collision_rate", series.collision_rate, series.interval);
  if (plan.wants(Quantity::displacement)) {
    const DiffusionFit fit = diffusion_of(record, scene);
    means.push_back({"diffusion", fit.value, fit.error});
  }
  if (plan.wants(Quantity::bond_order)) {
    add("bond_order_local", series.local_order);
    add("bond_order_global", series.global_order);
  }
  return means;
}

}  // namespace carom
