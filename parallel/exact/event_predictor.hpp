// The prediction of a disk's next event: its earliest contact with a side or with a disk of its neighbour list.
#pragma once

#include <algorithm>
#include <cstdint>

#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/prediction_kernel.hpp"
#include "parallel/exact/window_state.hpp"

namespace carom {

struct NextEvent {
  double time = never;
  DiskId id1 = 0, id2 = 0;  // of the event; id2 may be a wall_partner
  Partner partner;          // of the disk whose event it is
};

class EventPredictor {
 public:
  EventPredictor(const WindowState& window, const NeighbourLists& lists)
      : window_(&window),
        lists_(&lists),
        kernels_(choose_prediction_kernels(window.rules.gravity != 0.0, !window.disks->radius.empty())),
        constants_(constants_of(window)),
        fastest2_(window.fastest2) {}

  // The earliest event of disk i with a side or a neighbour, up to the horizon, all on their present paths. lasting:
  // one of its contacts lasts (WindowState::close), so that the next window may see other events.
  NextEvent earliest(std::uint32_t i, bool& lasting) const;

  // To be called for every segment that begins, with its v^2.
  void note_speed(double v2) { fastest2_ = std::max(fastest2_, v2); }
  double fastest2() const { return fastest2_; }

 private:
  // May it, or a disk that it meets, move so far that images beyond the nearest one or crossing events matter?
  bool moves_far(const PathSegment& path) const {
    return !(std::max(fastest2_, path.vx * path.vx + path.vy * path.vy) <= window_->safe_speed2);
  }
  NextEvent earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far, bool& lasting) const;
  void see_collision_with_images(std::uint32_t i, std::uint32_t j, NextEvent& best) const;
  void see_collision(std::uint32_t i, std::uint32_t j, double time, NextEvent& best) const;
  static PredictionConstants constants_of(const WindowState& window);

  const WindowState* window_;
  const NeighbourLists* lists_;
  PredictionKernels kernels_;
  PredictionConstants constants_;
  double fastest2_;  // largest v^2 so far
};

}  // namespace carom
