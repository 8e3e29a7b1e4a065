// The runs that are left of a sweep, for another program to start. Afterwards `carom sweep` with the same arguments has
// only the table to write.
#pragma once

#include <string>

#include "app/sweep/sweep.hpp"

namespace carom {

// For sh: GNU parallel, a line a run.
std::string parallel_script(const Sweep& sweep);

// For sbatch: an array of tasks, one a run.
std::string slurm_script(const Sweep& sweep);

}  // namespace carom
