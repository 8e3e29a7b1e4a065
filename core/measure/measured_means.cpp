#include "core/measure/measured_means.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/blocking_error.hpp"
#include "core/base/sample_mean.hpp"
#include "core/measure/bond_order.hpp"
#include "core/scene/drawn_velocities.hpp"

namespace carom {

namespace {

// Had every sample fewer disks than this?
bool always_fewer(const SampleSeries& series, Count least) {
  const auto few = [least](double disks) { return disks < static_cast<double>(least); };
  return !series.time.empty() && std::all_of(series.disks.begin(), series.disks.end(), few);
}

}  // namespace

DiffusionFit diffusion_of(const AnalysisRecord& record, const Scene& scene) {
  return fit_diffusion(record.series.time, record.series.displacement, scene.box.shear.acts() ? 1.0 : 2.0);
}

std::vector<MeasuredMean> measured_means(const AnalysisRecord& record, const Scene& scene) {
  const SampleSeries& series = record.series;
  std::vector<MeasuredMean> means;
  const auto add = [&](std::string_view name, const std::vector<double>& values,
                       const std::vector<double>& weights = {}) -> MeasuredMean& {
    return means.emplace_back(MeasuredMean{name, sample_mean(values, weights).mean, blocking_error(values, weights)});
  };
  const AnalysisPlan& plan = scene.analysis;
  if (plan.wants(Quantity::pressure)) {
    MeasuredMean& mean = add("pressure", series.pressure, series.interval);
    if (velocities_are_drawn(scene)) mean.missing = "Brownian disks have no velocities";
  }
  if (plan.wants(Quantity::collision_rate)) {
    MeasuredMean& mean = add("collision_rate", series.collision_rate, series.interval);
    if (plan.group.empty() && always_fewer(series, 1)) mean.missing = "there are no disks";
  }
  if (plan.wants(Quantity::displacement)) {
    const DiffusionFit fit = diffusion_of(record, scene);
    MeasuredMean& mean = means.emplace_back(MeasuredMean{"diffusion", fit.value, fit.error});
    if (!std::isnan(fit.from)) {
      const bool none = series.followed.front() == 0.0;
      mean.missing = none ? "the first sample had no disks" : "the disks of the first sample are gone";
    }
  }
  if (plan.wants(Quantity::bond_order)) {
    const bool few = always_fewer(series, least_of_bonds);
    for (const auto& [name, values] :
         {std::pair{"bond_order_local", &series.local_order}, std::pair{"bond_order_global", &series.global_order}}) {
      MeasuredMean& mean = add(name, *values);
      if (few) mean.missing = "there are fewer than seven disks";
    }
  }
  return means;
}

}  // namespace carom
