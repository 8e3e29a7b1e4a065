// The curves that an analysis comes to, from its counts: what the file holds and the plots show.
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

// g(r): pairs found over those expected of disks strewn at random, which have sum of n (n - 1) / A times the area of a
// bin's ring. NaN before there is anything to expect.
BinnedCurve pair_correlation_curve(const PairRecord& pairs, const AnalysisPlan& plan);

// The same of the pairs of two groups, which expect 2 n1 n2 / A; of a group with itself n (n - 1) / A.
struct PartialCurve {
  std::string group, other;
  std::vector<double> g;
};
std::vector<PartialCurve> partial_curves(const AnalysisRecord& record, const AnalysisPlan& plan);

// g6(r): mean of Re(psi6* psi6') over the pairs in a bin; NaN where there is none.
BinnedCurve bond_correlation_curve(const AnalysisRecord& record, const AnalysisPlan& plan);

// Probability densities of the reduced speed: measured, and that of equilibrium; means over each bin. The measured one
// counts what is faster than the last bin, too, so that it need not have the area 1. NaN where nothing was measured.
BinnedCurve speed_curve(const AnalysisRecord& record, const AnalysisPlan& plan);
BinnedCurve maxwell_curve(const AnalysisPlan& plan);

// Share of each slab that disks cover, and disks per area; means over the samples.
BinnedCurve packing_curve(const DensityProfile& density, const Scene& scene);
BinnedCurve number_density_curve(const DensityProfile& density, const Scene& scene);

// Of each slab; NaN where no disk was.
struct ProfileCurves {
  std::vector<double> position, vx, vy, temperature;
};
ProfileCurves profile_curves(const MotionProfile& profile, const Scene& scene);

// The rows of a run to t_end: there is none beyond it, as the last moment belongs to the last row.
std::vector<DensityProfile> density_rows_of_run(const AnalysisRecord& record, const Scene& scene);
std::vector<MotionProfile> motion_rows_of_run(const AnalysisRecord& record, const Scene& scene);

// Times at which the first `rows` rows of a profile begin that has one for each `every`.
std::vector<double> row_times(std::size_t rows, double every, const Scene& scene);

// Wave numbers, 1 / length, and S(k); empty along an axis that is not periodic.
struct StructureCurve {
  std::vector<double> k, s;
};
StructureCurve structure_along_x(const AnalysisRecord& record, const Scene& scene);
StructureCurve structure_along_y(const AnalysisRecord& record, const Scene& scene);

}  // namespace carom
