// The prediction of a disk's next event: its earliest contact with a side or with a disk of its neighbour list.
#pragma once

#include <cstdint>

#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/prediction_kernel.hpp"
#include "parallel/exact/window_state.hpp"

namespace carom {

struct NextEvent {
  double time = never;
  Partner partner;       // of the disk whose event it is
  bool lasting = false;  // a contact of the disk lasts (WindowState::close): the next window may see other events
};

class EventPredictor {
 public:
  EventPredictor(const WindowState& window, const NeighbourLists& lists)
      : window_(&window),
        lists_(&lists),
        kernels_(choose_prediction_kernels(kind_of(window.rules.gravity), !window.disks->radius.empty())),
        constants_(constants_of(window, lists)),
        fastest2_(window.fastest2) {
    see_far();
  }

  // Does the kernel alone tell the disk's first event, but for what is ambiguous?
  bool kernel_tells(const ListRow& row) const { return row.is_plain() && !more_than_neighbours_; }
  // Then: its first contact. newest: no neighbour's segment starts later than the disk's own. stay2: as the kernel has
  // it.
  template <bool newest>
  FirstContact first_in(const ListRow& row, std::uint32_t i, double stay2) const {
    const auto kernel = row.is_inside() ? (newest ? kernels_.inside_newest : kernels_.inside)
                                        : (newest ? kernels_.near_newest : kernels_.near);
    return kernel(constants_, &window_->record[i], row, stay2);
  }
  static Partner partner_in(const ListRow& row, std::uint32_t i, const FirstContact& first) {
    return Partner::disk(i + static_cast<std::uint32_t>(std::int32_t{row.offset[first.neighbour]}));
  }

  // The earliest event of disk i with a side or a neighbour, up to the horizon, all on their present paths.
  NextEvent earliest(std::uint32_t i) const;

  // To be called for every segment that begins, with its v^2.
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
    more_than_neighbours_ = far_ || window_->rules.box.obstacles != nullptr || window_->rules.box.shear.acts();
  }
  FirstContact first_contact(std::uint32_t i) const;
  NextEvent earliest_with_sides(std::uint32_t i) const;
  NextEvent earliest_one_by_one(std::uint32_t i) const;
  NextEvent earliest_at_sides(std::uint32_t i) const;
  void see_obstacles(std::uint32_t i, double end, NextEvent& best) const;
  bool lists_images(std::uint32_t i) const;
  bool touches_slowly(const PathSegment& path, double radius) const;
  bool comes_first(std::uint32_t i, const NextEvent& a, const NextEvent& b) const;
  static PredictionConstants constants_of(const WindowState& window, const NeighbourLists& lists);

  const WindowState* window_;
  const NeighbourLists* lists_;
  PredictionKernels kernels_;
  PredictionConstants constants_;
  double fastest2_;  // largest v^2 so far
  // Obstacles, a shear, or far_: then the kernel does not tell all.
  bool more_than_neighbours_ = false;
  bool far_ = false;  // may a disk move so far that images beyond the nearest one, or crossing events, matter?
};

}  // namespace carom
