// The prediction kernel: when a disk first touches one of its neighbours. One version for each instruction set.
#pragma once

#include <cstdint>

#include "core/physics/exact_path.hpp"
#include "parallel/exact/disk_record.hpp"

namespace carom {

// The same for all disks.
struct PredictionConstants {
  double gravity = 0.0;                        // length / time^2
  double width = 0.0, height = 0.0;            // periods; 0: none
  double half_width = 0.0, half_height = 0.0;  // infinite where there is no period
  // A contact lasts where the squares of distance^2 - contact_distance^2 and of dr.dv are within these: rounding
  // decides in every window whether there is an event.
  double close2 = 0.0, slow2 = 0.0;
};

// The first contacts: their time, `never` if there is none, and bit k for each neighbour k that is touched then.
struct FirstContacts {
  double time = never;
  std::uint32_t bits = 0;
  bool lasting = false;  // a contact with one of the neighbours lasts
};

// Neighbours in one call, at most.
inline constexpr std::uint32_t max_batch = 28;

// The first of the contacts of disk *own with own[offset[k]], k < count <= max_batch: the same bits as core's
// collision_time() gives, where no image beyond the nearest one can be reached. Offsets beyond count, up to the next
// multiple of four, are 0: a disk has no contact with itself.
template <class Offset>
using PredictionKernel = FirstContacts (*)(const PredictionConstants& constants, const DiskRecord* own,
                                           const Offset* offset, std::uint32_t count);

struct PredictionKernels {
  PredictionKernel<std::int16_t> near;
  PredictionKernel<std::int32_t> far;
};

// For a scene with gravity or without, with radii that differ or not.
PredictionKernels prediction_kernels_baseline(bool gravity, bool unequal_radii);
PredictionKernels prediction_kernels_avx2(bool gravity, bool unequal_radii);
// The best version for the processor at hand.
PredictionKernels choose_prediction_kernels(bool gravity, bool unequal_radii);

}  // namespace carom
