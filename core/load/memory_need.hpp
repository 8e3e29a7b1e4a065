// A lower bound on the memory of a run, known before anything is allocated: a count with a zero too many should give
// one line of error, not minutes of swapping.
#pragma once

#include "core/base/types.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Least bytes of a run with this number of disks: state, cells and lists of the method, without contacts. rough: disks
// spin. Measured peaks are in docs/benchmarks.md.
double least_memory(Method method, Count disks, bool rough = false);

}  // namespace carom
