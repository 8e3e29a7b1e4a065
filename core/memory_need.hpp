// Whether a machine can hold a scene at all, asked before anything is made of it: a count with a zero too many should
// be one line, not minutes of swapping.
#pragma once

#include "core/scene.hpp"
#include "core/types.hpp"

namespace carom {

// From so many disks on the exact method trades time for memory: its slices are shorter, so that less is held in each.
inline constexpr Count lean_exact_disks = 50'000'000;

// Bytes that a run of so many disks takes at the very least: state, cells and lists of the method; what contacts add is
// left out. Measured peaks are in docs/benchmarks.md.
double least_memory(Method method, Count disks);

// Bytes of the machine's memory; infinity where it does not say.
double machine_memory();

}  // namespace carom
