// The prediction kernel: it finds when a disk first touches one of its neighbours. There is one version for each
// instruction set.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/physics/exact_path.hpp"
#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/flow_frame.hpp"
#include "parallel/exact/list_row.hpp"

namespace carom {

// The number of neighbours that the kernel processes at a time. A list is padded to a multiple of it with offsets of
// its own.
inline constexpr std::uint32_t prediction_lanes = 4;

// The same number in each lane.
struct alignas(32) LaneConstant {
  double lane[prediction_lanes];
};
struct alignas(16) AlongAxes {
  double x = 0.0, y = 0.0;
};
constexpr LaneConstant in_all_lanes(double a) {
  return {{a, a, a, a}};
}

// Constants that are the same for all disks, or for all with the same relist distance.
struct PredictionConstants {
  // Value of stay2 and stay with which no disk is certain to stay listed.
  static constexpr double never_listed = -1.0;
  LaneConstant period_x = in_all_lanes(0.0), period_y = in_all_lanes(0.0);            // length; 0: none
  LaneConstant periods_per_x = in_all_lanes(0.0), periods_per_y = in_all_lanes(0.0);  // 1 / period; 0: none
  LaneConstant down = in_all_lanes(0.0), half_down = in_all_lanes(0.0);               // gravity; length / time^2
  LaneConstant left = in_all_lanes(0.0), half_left = in_all_lanes(0.0);
  LaneConstant contact2 = in_all_lanes(0.0);  // squared contact distance of equal disks
  // (dr.dv)^2 of a pair that approaches so slowly that its contact may last (WindowState::close).
  LaneConstant slow_approach2 = in_all_lanes(0.0);
  // Negative. Rounding shifts the square of the distance at which two disks pass each other by at most this: blur over
  // the contact distance (WindowState::blur), and blur2 for equal disks.
  LaneConstant blur = in_all_lanes(0.0), blur2 = in_all_lanes(0.0);
  LaneConstant zero = in_all_lanes(0.0);
  LaneConstant never = in_all_lanes(carom::never);
  // All bits but the sign: masks the sign; as a number it is not a number.
  LaneConstant magnitude_bits = in_all_lanes(std::bit_cast<double>(0x7fffffffffffffffULL));
  double stay2 = never_listed;  // the relist distance squared, a little less; for straight paths
  double stay = never_listed;   // the relist distance, a little less; for bent paths
  // Going from one image of its listed position to another, a disk flies further than this: a period less twice the
  // relist distance; length. The second is its square.
  double to_other_image = carom::never, to_other_image2 = carom::never;
  double eighth_gravity = 0.0;           // gravity's size / 8
  AlongAxes half_gravity;                // to the left and down
  FlowFrame flow;                        // of a sheared box
  AlongAxes listed_unit;                 // of a FixedPointPosition; length
  AlongAxes period, periods_per_length;  // as above
  // The last bits of 2^52 + n are those of the whole number n.
  AlongAxes whole = {0x1p52, 0x1p52};
  // 0, 1, 2, ...: the places of a batch of neighbours are read from the first one on.
  std::array<long long, row_offsets> place = [] {
    std::array<long long, row_offsets> numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<long long>(k);
    return numbers;
  }();

  // Used only for images beyond the nearest one.
  LaneConstant image_x = in_all_lanes(carom::never), image_y = in_all_lanes(carom::never);  // period; never: none
  LaneConstant contact = in_all_lanes(0.0);               // contact distance of equal disks
  LaneConstant horizon = in_all_lanes(0.0);               // time up to which contacts matter
  LaneConstant margin = in_all_lanes(far_travel_margin);  // core's time_to_far_contact
  // In a sheared box: the displacement of the images above at the window's start, a length, and their velocity.
  LaneConstant offset = in_all_lanes(0.0), jump = in_all_lanes(0.0);
};

// The first contact of a disk with one of its neighbours.
struct FirstContact {
  double time = never;  // `never`: there is none; not a number: is_ambiguous()
  // The neighbour's place in the list; for a row, possibly with leaving_bit.
  std::uint32_t neighbour = 0;
  static constexpr std::uint32_t leaving_bit = 1U << 31;

  // For a row: at the time of contact the disk is further than the relist distance from its listed position; if its
  // path is bent, possibly only before that time.
  bool leaves_list() const { return (neighbour & leaving_bit) != 0; }
  // The kernel cannot decide: two neighbours are touched at the same time, or a neighbour is approached slowly, or
  // passed so near to the contact distance that rounding decides whether it is touched.
  bool is_ambiguous() const { return std::isnan(time); }
};

// Kernels that find the first of the contacts of disk *own with own[offset[k]], k < count, with the same bits as core's
// collision_time(). Preconditions: offsets beyond count, up to the next multiple of prediction_lanes, are equal to
// others of the list; while paths last, no neighbour's nearest image is further away than 0.49 periods, except for the
// two *_any_image kernels. newest: no neighbour's segment starts later than the disk's own.
// A RowKernel takes the offsets of a row.
using RowKernel = FirstContact (*)(const PredictionConstants& constants, const DiskRecord* own, const ListRow& row);
using WideRowKernel = FirstContact (*)(const PredictionConstants& constants, const DiskRecord* own,
                                       const std::int32_t* offset, std::uint32_t count);

struct PredictionKernels {
  RowKernel near, near_newest;
  // If all places are on the same side of each border along a period, so that no image but the disks themselves is met.
  RowKernel inside, inside_newest;
  WideRowKernel far;
  // If neighbours fly so far that images beyond the nearest one may be met, too.
  RowKernel near_any_image;
  WideRowKernel far_any_image;
  // In a sheared box, if a neighbour may be listed across the bottom or the top. If an image beyond the nearest one may
  // be met, the result is ambiguous. Null without a shear.
  RowKernel near_sheared;
  WideRowKernel far_sheared;
};

// What bends the paths of a scene, or the frame in which they are listed: nothing, gravity along y alone, any gravity,
// or the flow of a sheared box, in which no gravity acts.
enum class Bend { none, down, tilted, flow };
inline Bend bend_of(const Gravity& g, const Domain& box) {
  if (box.shear.acts()) return Bend::flow;
  return g.is_tilted() ? Bend::tilted : g.acts() ? Bend::down : Bend::none;
}

// The kernels for a scene with such paths, with different or equal radii.
PredictionKernels prediction_kernels_baseline(Bend bend, bool unequal_radii);
PredictionKernels prediction_kernels_avx2(Bend bend, bool unequal_radii);
// The best version for the processor in use.
PredictionKernels choose_prediction_kernels(Bend bend, bool unequal_radii);

}  // namespace carom
