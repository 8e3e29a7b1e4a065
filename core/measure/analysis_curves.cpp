#include "core/measure/analysis_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/column.hpp"

namespace carom {

namespace {

// The curve over the bins of [0, end].
BinnedCurve curve_of(double end, const Column& value) {
  const auto bins = static_cast<double>(value.size());
  const Column middle = end / bins * Column::LinSpaced(value.size(), 0.5, bins - 0.5);
  return {{middle.begin(), middle.end()}, {value.begin(), value.end()}};
}

double length_of_profile(const Scene& scene) {
  return scene.analysis.density_along_x ? scene.box.width : scene.box.height;
}

// Area of one slab, summed over the samples; length^2.
double slab_area(const DensityProfile& density, const Scene& scene) {
  return scene.box.width * scene.box.height / static_cast<double>(density.centres.size()) *
         static_cast<double>(density.samples);
}

// Areas of the rings between r and r + width, pi (outer^2 - inner^2), where (k + 1)^2 - k^2 = 2 k + 1; length^2.
Column ring_areas(const DistanceBins& bins) {
  const double width = bins.r_max / static_cast<double>(bins.bins);
  const auto count = static_cast<Eigen::Index>(bins.bins);
  return std::numbers::pi * width * width * Column::LinSpaced(count, 1.0, 2.0 * static_cast<double>(count) - 1.0);
}

}  // namespace

BinnedCurve pair_correlation_curve(const PairRecord& pairs, const AnalysisPlan& plan) {
  const double expected = pairs.expected > 0.0 ? pairs.expected : std::numeric_limits<double>::quiet_NaN();
  return curve_of(plan.pairs.r_max,
                  column_of(pairs.counts).cast<double>() / (expected * ring_areas(distance_bins(plan.pairs))));
}

std::vector<PartialCurve> partial_curves(const AnalysisRecord& record, const AnalysisPlan& plan) {
  std::vector<PartialCurve> curves;
  for (std::size_t k = 0; k < plan.pair_groups.size(); ++k) {
    for (std::size_t l = k; l < plan.pair_groups.size(); ++l) {
      const PairRecord& pairs = record.partial[curves.size()];
      curves.push_back({plan.pair_groups[k].name, plan.pair_groups[l].name, pair_correlation_curve(pairs, plan).value});
    }
  }
  return curves;
}

BinnedCurve bond_correlation_curve(const AnalysisRecord& record, const AnalysisPlan& plan) {
  const Column pairs = column_of(record.bonds.pairs).cast<double>();
  return curve_of(plan.bonds.r_max, column_of(record.bonds.product) / pairs);
}

BinnedCurve speed_curve(const AnalysisRecord& record, const AnalysisPlan& plan) {
  const auto counts = column_of(record.speeds.counts);
  const auto disks = static_cast<double>(counts.sum() + record.speeds.beyond);
  const double width = plan.speed_max / static_cast<double>(counts.size());
  return curve_of(plan.speed_max, counts.cast<double>() / (disks * width));
}

BinnedCurve maxwell_curve(const AnalysisPlan& plan) {
  const auto bins = static_cast<std::size_t>(plan.speed_bins);
  const double width = plan.speed_max / static_cast<double>(bins);
  const auto share = [&](Eigen::Index k) { return maxwell_share(plan.speed_max, bins, static_cast<std::size_t>(k)); };
  return curve_of(plan.speed_max, Column::NullaryExpr(static_cast<Eigen::Index>(bins), share) / width);
}

BinnedCurve packing_curve(const DensityProfile& density, const Scene& scene) {
  return curve_of(length_of_profile(scene), column_of(density.covered) / slab_area(density, scene));
}

BinnedCurve number_density_curve(const DensityProfile& density, const Scene& scene) {
  return curve_of(length_of_profile(scene), column_of(density.centres).cast<double>() / slab_area(density, scene));
}

namespace {

template <class Profile>
std::vector<Profile> rows_of_run(std::vector<Profile> rows, const Scene& scene, double every) {
  const double parts = std::ceil((scene.run.t_end - scene.analysis.start) / every - row_edge);
  const double all = std::max(1.0, parts);
  while (static_cast<double>(rows.size()) > all) {
    join(rows[rows.size() - 2], rows.back());
    rows.pop_back();
  }
  return rows;
}

}  // namespace

std::vector<DensityProfile> density_rows_of_run(const AnalysisRecord& record, const Scene& scene) {
  return rows_of_run(record.density_rows, scene, scene.analysis.density_every);
}

std::vector<MotionProfile> motion_rows_of_run(const AnalysisRecord& record, const Scene& scene) {
  return rows_of_run(record.motion_rows, scene, scene.analysis.profile_every);
}

std::vector<double> row_times(std::size_t rows, double every, const Scene& scene) {
  std::vector<double> times;
  for (std::size_t k = 0; k < rows; ++k) times.push_back(scene.analysis.start + static_cast<double>(k) * every);
  return times;
}

ProfileCurves profile_curves(const MotionProfile& profile, const Scene& scene) {
  ProfileCurves curves;
  const std::size_t slabs = profile.disks.size();
  const double length = scene.analysis.profile_along_x ? scene.box.width : scene.box.height;
  for (std::size_t k = 0; k < slabs; ++k) {
    const SlabMotion motion = motion_of_slab(profile, k);
    curves.position.push_back(length * (static_cast<double>(k) + 0.5) / static_cast<double>(slabs));
    curves.vx.push_back(motion.velocity.x);
    curves.vy.push_back(motion.velocity.y);
    curves.temperature.push_back(motion.temperature);
  }
  return curves;
}

namespace {

StructureCurve structure_of(const std::vector<double>& sums, Count samples, double period) {
  StructureCurve curve;
  for (std::size_t n = 0; n < sums.size(); ++n) {
    curve.k.push_back(2.0 * std::numbers::pi * static_cast<double>(n + 1) / period);
    curve.s.push_back(sums[n] / static_cast<double>(samples));
  }
  return curve;
}

}  // namespace

StructureCurve structure_along_x(const AnalysisRecord& record, const Scene& scene) {
  return structure_of(record.structure.along_x, record.structure.samples, scene.box.width);
}

StructureCurve structure_along_y(const AnalysisRecord& record, const Scene& scene) {
  return structure_of(record.structure.along_y, record.structure.samples, scene.box.height);
}

}  // namespace carom
