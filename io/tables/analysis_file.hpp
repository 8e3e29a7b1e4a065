// analysis.h5: what a run measured on its way, as HDF5.
#pragma once

#include <string>

#include "core/measure/analysis.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// /samples            time, disks; temperature with pressure or speeds
// /displacement       mean_square, disks: those that it is a mean over
// /pressure, /collision_rate   value: mean over the interval, which ends with the step that the sample lies in; NaN
//                              where no step has ended since the sample before; the mean weighs by intervals
// /pair_correlation   r, g; pairs: ordered ones counted; in partial, where groups are named, g:A:B and pairs:A:B
// /bond_correlation   r, g6; pairs counted
// /speeds             u = v sqrt(m / T), measured, maxwell (both densities, means over the bin); counts
// /density            position, packing_fraction, number_density; centres counted; in rows, where the scene says every,
//                     the same of each part of the run as tables [row][bin], and the time at which it begins
// /profile            position, velocity_x, velocity_y, temperature; disks counted; rows likewise
// /velocity_autocorrelation, /bond_autocorrelation, /bond_order   value; value; local, global: an entry a sample
// /structure_factor   kx, along_x; ky, along_y: along periodic axes
// /parameters/scene   the scene with all defaults, as TOML
// Whatever was not asked for is not there. r, u and position are the middles of the bins. Attributes say the units, how
// many samples went in, and what a shear flow changes in the meaning; of a series, its mean, how its samples scatter,
// and the standard error of the mean by blocking (blocking_error.hpp); of the displacement, the diffusion coefficient
// of its second half with its error (diffusion_fit.hpp).
//
// Writes a new file and renames it, so that an intact one exists at any moment. Throws RunError.
void write_analysis(const std::string& path, const Scene& scene, const AnalysisRecord& record);

}  // namespace carom
