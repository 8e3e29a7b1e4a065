// When a disk meets its neighbours: the kernel of the look around, in the versions that this machine may have.
#pragma once

#include <cstdint>

#include "core/physics/exact_path.hpp"
#include "parallel/exact/exact_flight.hpp"

namespace carom {

// What all disks have in common.
struct MeetingFrame {
  double gravity = 0.0;                        // length / time^2
  double width = 0.0, height = 0.0;            // periods; 0: none
  double half_width = 0.0, half_height = 0.0;  // infinite where there is no period
  // A contact lasts where distance^2 - reach^2 and dr.dv are within these, squared: rounding may turn it into a meeting
  // or no meeting in every window.
  double close2 = 0.0, slow2 = 0.0;
};

// The first meetings: their time, `never` if there is none, and bit k for each neighbour k that is met then.
struct FirstMeetings {
  double time = never;
  std::uint32_t bits = 0;
  bool lasting = false;  // a contact with one of the neighbours lasts
};

// Up to so many neighbours at a time.
inline constexpr std::uint32_t most_neighbours = 28;

// The first of the meetings of disk *own with own[offset[k]], k < count <= most_neighbours: the same bits as core's
// meeting_time() gives, where nobody can reach an image beyond the nearest one. Offsets beyond count, up to the next
// multiple of four, are 0: a disk does not meet itself.
template <class Offset>
using MeetingKernel = FirstMeetings (*)(const MeetingFrame& frame, const Flight* own, const Offset* offset,
                                        std::uint32_t count);

struct MeetingKernels {
  MeetingKernel<std::int16_t> near;
  MeetingKernel<std::int32_t> far;
};

// For a scene with gravity or without, with radii that differ or not.
MeetingKernels meeting_kernels_baseline(bool gravity, bool unequal_radii);
MeetingKernels meeting_kernels_avx2(bool gravity, bool unequal_radii);
// The best version for the processor at hand.
MeetingKernels choose_meeting_kernels(bool gravity, bool unequal_radii);

}  // namespace carom
