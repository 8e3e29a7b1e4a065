// The diffusion coefficient that a mean square displacement shows at late times.
#pragma once

#include <vector>

namespace carom {

// D of <r^2> = 2 d D t + constant in d dimensions; length^2 / time.
struct DiffusionFit {
  double value = 0.0;  // NaN where there are too few samples
  double error = 0.0;  // standard error; NaN likewise
  double from = 0.0;   // time of the first sample that counts
};

// The second half of the samples (in time): the slope from end to end, and its standard error from the scatter of the
// slopes of eight parts of about the same length, or of four where those scatter more. Slopes of parts are independent
// where displacements are, as those of a random walk; a part that is not long against the time between collisions goes
// on as the one before did, and the error comes out too small: by a quarter to two fifths where an eighth is as long as
// three collisions of a disk, by a tenth from six on (200 and 1000 disks, packing fraction 0.3). In a dense fluid that
// time is the one in which the longest shear wave of the box decays, L^2 / (4 pi^2 nu), as disks carry each other
// along: at packing fraction 0.6 the error is too small by a half where an eighth is 0.13 of it, by a third at 0.5, and
// right from 2 on (512 and 2048 disks). Means nothing where disks still fly freely, or where walls stop them. square:
// of each time; NaN where no disk is left. Precondition: times rise.
DiffusionFit fit_diffusion(const std::vector<double>& time, const std::vector<double>& square, double dimensions = 2.0);

}  // namespace carom
