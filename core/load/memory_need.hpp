// Whether a machine can hold a scene at all, asked before anything is made of it: a count with a zero too many should
// be one line, not minutes of swapping.
#pragma once

#include "core/base/types.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Bytes that a run of so many disks takes at the very least: state, cells and lists of the method; what contacts add is
// left out. Measured peaks are in docs/benchmarks.md.
double least_memory(Method method, Count disks, bool rough = false);

}  // namespace carom
