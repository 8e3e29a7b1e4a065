// The prediction of a disk's next event: its earliest contact with a side or with a disk of its neighbour list.
#pragma once

#include <array>
#include <cstdint>

#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/prediction_kernel.hpp"
#include "parallel/exact/window_state.hpp"

namespace carom {

struct NextEvent {
  double time = never;
  Partner partner;  // of the disk whose event this is
  // The disk is in a lasting contact (WindowState::close): rounding at the next window's start may change its events.
  bool lasting = false;
};

class EventPredictor {
 public:
  EventPredictor(const WindowState& window, const NeighbourLists& lists)
      : window_(&window),
        lists_(&lists),
        kernels_(
            choose_prediction_kernels(bend_of(window.rules.gravity, window.rules.box), !window.disks->radius.empty())),
        constants_{constants_of(window, lists, false), constants_of(window, lists, true)},
        fastest2_(window.fastest2) {
    see_far();
  }

  // Does the kernel alone find the disk's first event, unless the result is ambiguous?
  [[gnu::always_inline]] bool kernel_tells(const ListRow& row) const {
    return ((row.sides | more_than_neighbours_) & ListRow::not_plain) == 0;
  }
  // The first contact of a disk for which kernel_tells(). newest: no neighbour's segment starts later than the disk's
  // own. near_border: which of the two relist distances applies to the disk.
  template <bool newest>
  FirstContact first_in(const ListRow& row, const DiskRecord& own, bool near_border) const {
    const auto kernel = row.is_inside() ? (newest ? kernels_.inside_newest : kernels_.inside)
                                        : (newest ? kernels_.near_newest : kernels_.near);
    return kernel(constants_[near_border ? 1 : 0], &own, row);
  }
  static Partner partner_in(const ListRow& row, std::uint32_t i, const FirstContact& first) {
    const std::uint32_t place = first.neighbour & ~FirstContact::leaving_bit;
    return Partner::disk(i + static_cast<std::uint32_t>(std::int32_t{row.offset[place]}));
  }

  // The earliest event of disk i with a side, an obstacle or a neighbour, up to the horizon, if all disks stay on their
  // present paths.
  [[gnu::hot]] NextEvent earliest(std::uint32_t i) const;

  // Must be called with v^2 of every segment that begins.
  void note_speed(double v2) {
    if (v2 <= fastest2_) [[likely]]
      return;
    fastest2_ = v2;
    see_far();
  }
  double fastest2() const { return fastest2_; }

 private:
  void see_far() {
    far_ = !(fastest2_ <= window_->safe_speed2);
    more_than_neighbours_ = far_ ? ListRow::not_plain : 0U;
  }
  [[gnu::hot]] FirstContact first_contact(std::uint32_t i) const;
  [[gnu::hot]] NextEvent earliest_with_sides(std::uint32_t i) const;
  NextEvent earliest_one_by_one(std::uint32_t i) const;
  [[gnu::hot]] NextEvent earliest_at_sides(std::uint32_t i) const;
  void see_obstacles(std::uint32_t i, double end, NextEvent& best) const;
  bool sees_moving_images(const ListRow& row) const;
  bool comes_first(std::uint32_t i, const NextEvent& a, const NextEvent& b) const;
  static PredictionConstants constants_of(const WindowState& window, const NeighbourLists& lists, bool near_border);

  const WindowState* window_;
  const NeighbourLists* lists_;
  PredictionKernels kernels_;
  std::array<PredictionConstants, 2> constants_;  // for disks elsewhere, and for those near a border
  double fastest2_;                               // largest v^2 so far
  // Bits of ListRow::sides; set if far_ is set, since the kernel alone does not find all events then.
  std::uint8_t more_than_neighbours_ = 0;
  bool far_ = false;  // may a disk move so far that images beyond the nearest one, or crossing events, matter?
};

}  // namespace carom
