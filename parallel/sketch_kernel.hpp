// Which of a disk's neighbours it may meet, told from sketches of their paths, in the versions that this machine may
// have.
#pragma once

#include <cstdint>

#include "parallel/path_sketch.hpp"

namespace carom {

// The disk that looks, in sketch units; and what all its neighbours have in common.
struct SketchFrame {
  float from = 0.0F;                            // time of the look
  float x = 0.0F, y = 0.0F;                     // place then
  float vx = 0.0F, vy = 0.0F;                   // velocity in the falling frame
  float width = 0.0F, height = 0.0F;            // periods; 0: none
  float half_width = 0.0F, half_height = 0.0F;  // infinite where there is no period
  float slack = 0.0F;                           // rounding of a place, generously
  float reach = 0.0F;                           // r1 + r2 with slack, or r1 with slack where radii differ
  const double* radius = nullptr;               // where radii differ, by storage index
  float per_length = 1.0F;                      // sketch units per length of the scene, for radii
};

inline constexpr std::uint32_t most_sketches = 32;

// Bit k is set unless the disk and neighbour disk[k] surely do not meet: they recede, or pass each other. Then
// soonest[k], in sketch units from the look on, is a time before which they do not touch. Conservative, whatever the
// numbers: what overflows or is not a number is never ruled out. disk has room for a whole number of eights and is
// filled up by this; count <= most_sketches.
using SketchKernel = std::uint32_t (*)(const SketchFrame& frame, const PathSketch* sketches, std::uint32_t* disk,
                                       std::uint32_t count, float* soonest);

std::uint32_t sketch_meetings_baseline(const SketchFrame& frame, const PathSketch* sketches, std::uint32_t* disk,
                                       std::uint32_t count, float* soonest);
std::uint32_t sketch_meetings_avx2(const SketchFrame& frame, const PathSketch* sketches, std::uint32_t* disk,
                                   std::uint32_t count, float* soonest);

// The best version for the processor at hand.
SketchKernel choose_sketch_kernel();

}  // namespace carom
