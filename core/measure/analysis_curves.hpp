// The curves of an analysis, computed from its counts: for the output file and the plots.
#pragma once

#include <string>
#include <vector>

#include "core/measure/analysis.hpp"

namespace carom {

// A quantity over the middles of its bins.
struct BinnedCurve {
  std::vector<double> middle;
  std::vector<double> value;
};

// g(r): the pairs found over those expected of disks at random places, which is the sum of n (n - 1) / A times the area
// of a bin's ring. NaN if no pairs are expected.
BinnedCurve pair_correlation_curve(const PairRecord& pairs, const AnalysisPlan& plan);

// The same for pairs of two groups, with 2 n1 n2 / A in place of n (n - 1) / A; for pairs within a group with n (n - 1)
// / A.
struct PartialCurve {
  std::string group, other;
  std::vector<double> g;
};
std::vector<PartialCurve> partial_curves(const AnalysisRecord& record, const AnalysisPlan& plan);

// g6(r): mean of Re(psi6* psi6') over the pairs in a bin; NaN where there is none.
BinnedCurve bond_correlation_curve(const AnalysisRecord& record, const AnalysisPlan& plan);

// Probability densities of the reduced speed, measured and in equilibrium; means over each bin. The measured density is
// normalised by all disks, including those faster than the last bin, so its area may be below 1. NaN if nothing was
// measured.
BinnedCurve speed_curve(const AnalysisRecord& record, const AnalysisPlan& plan);
BinnedCurve maxwell_curve(const AnalysisPlan& plan);

// For each slab, the share covered by disks, and disks per area; means over the samples.
BinnedCurve packing_curve(const DensityProfile& density, const Scene& scene);
BinnedCurve number_density_curve(const DensityProfile& density, const Scene& scene);

// One value for each slab; NaN where there was no disk.
struct ProfileCurves {
  std::vector<double> position, vx, vy, temperature;
};
ProfileCurves profile_curves(const MotionProfile& profile, const Scene& scene);

// The rows of a run to t_end. A sample at t_end itself is joined to the last row.
std::vector<DensityProfile> density_rows_of_run(const AnalysisRecord& record, const Scene& scene);
std::vector<MotionProfile> motion_rows_of_run(const AnalysisRecord& record, const Scene& scene);

// The times at which the first `rows` rows of a profile begin; every: their length in time.
std::vector<double> row_times(std::size_t rows, double every, const Scene& scene);

// Wave numbers, 1 / length, and S(k); empty along an axis that is not periodic.
struct StructureCurve {
  std::vector<double> k, s;
};
StructureCurve structure_along_x(const AnalysisRecord& record, const Scene& scene);
StructureCurve structure_along_y(const AnalysisRecord& record, const Scene& scene);

}  // namespace carom
