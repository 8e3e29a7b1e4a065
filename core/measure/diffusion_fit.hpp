// The diffusion coefficient from the late part of a mean square displacement.
#pragma once

#include <vector>

namespace carom {

// D of <r^2> = 2 d D t + constant in d dimensions; length^2 / time.
struct DiffusionFit {
  double value = 0.0;  // NaN with too few samples
  double error = 0.0;  // standard error; NaN likewise
  double from = 0.0;   // time of the first sample used
};

// Uses the second half of the samples (in time). The value is the slope from end to end; its standard error comes from
// the scatter of the slopes of eight parts of about equal length, or of four parts if those scatter more. The error is
// too small if the parts are not long against the correlation time of displacements, so that their slopes are
// correlated. In a gas that is the time between collisions: the error is too small by a quarter to two fifths if a part
// lasts three collisions of a disk, by a tenth from six on (200 and 1000 disks, packing fraction 0.3). In a dense fluid
// it is the decay time of the longest shear wave of the box, L^2 / (4 pi^2 nu): at packing fraction 0.6 the error is
// too small by a half if a part is 0.13 of it, by a third at 0.5, and right from 2 on (512 and 2048 disks). The value
// is meaningless while disks still fly freely, or where walls stop them. square: of each time; NaN if no disk is left.
// Precondition: times rise.
DiffusionFit fit_diffusion(const std::vector<double>& time, const std::vector<double>& square, double dimensions = 2.0);

}  // namespace carom
