// Scripts with the remaining runs of a sweep, to be started by another program. Afterwards `carom sweep` with the same
// arguments only has to write the table.
#pragma once

#include <string>

#include "app/sweep/sweep.hpp"

namespace carom {

// For sh: GNU parallel, with a line for each run.
std::string parallel_script(const Sweep& sweep);

// For sbatch: an array of tasks, one for each run.
std::string slurm_script(const Sweep& sweep);

}  // namespace carom
