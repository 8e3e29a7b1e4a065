#include "core/measure/analysis_curves.hpp"

#include <numeric>

namespace carom {

namespace {

// The curve value(k) over the bins of [0, end].
template <class Value>
BinnedCurve curve_of(double end, std::size_t bins, Value value) {
  BinnedCurve curve;
  const double width = end / static_cast<double>(bins);
  for (std::size_t k = 0; k < bins; ++k) {
    curve.middle.push_back(width * (static_cast<double>(k) + 0.5));
    curve.value.push_back(value(k));
  }
  return curve;
}

double length_of_profile(const Scene& scene) {
  return scene.analysis.density_along_x ? scene.box.width : scene.box.height;
}

// Area of all slabs of all samples, by the number of slabs.
double slab_area(const AnalysisRecord& record, const Scene& scene) {
  return scene.box.width * scene.box.height / static_cast<double>(record.density.centres.size()) *
         static_cast<double>(record.density.samples);
}

}  // namespace

BinnedCurve pair_correlation_curve(const AnalysisRecord& record, const AnalysisPlan& plan) {
  const DistanceBins bins = distance_bins(plan);
  return curve_of(plan.r_max, bins.bins, [&](std::size_t k) { return pair_correlation(record.pairs, bins, k); });
}

BinnedCurve speed_curve(const AnalysisRecord& record, const AnalysisPlan& plan) {
  const SpeedHistogram& h = record.speeds;
  const auto disks = static_cast<double>(std::accumulate(h.counts.begin(), h.counts.end(), h.beyond));
  const double width = plan.speed_max / static_cast<double>(h.counts.size());
  return curve_of(plan.speed_max, h.counts.size(),
                  [&](std::size_t k) { return static_cast<double>(h.counts[k]) / (disks * width); });
}

BinnedCurve maxwell_curve(const AnalysisPlan& plan) {
  const auto bins = static_cast<std::size_t>(plan.speed_bins);
  const double width = plan.speed_max / static_cast<double>(bins);
  return curve_of(plan.speed_max, bins, [&](std::size_t k) { return maxwell_share(plan.speed_max, bins, k) / width; });
}

BinnedCurve packing_curve(const AnalysisRecord& record, const Scene& scene) {
  const double area = slab_area(record, scene);
  return curve_of(length_of_profile(scene), record.density.covered.size(),
                  [&](std::size_t k) { return record.density.covered[k] / area; });
}

BinnedCurve number_density_curve(const AnalysisRecord& record, const Scene& scene) {
  const double area = slab_area(record, scene);
  return curve_of(length_of_profile(scene), record.density.centres.size(),
                  [&](std::size_t k) { return static_cast<double>(record.density.centres[k]) / area; });
}

}  // namespace carom
