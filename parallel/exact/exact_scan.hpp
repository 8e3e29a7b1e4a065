// The look around: whom a disk on its path meets first, of those in its list.
#pragma once

#include <algorithm>
#include <cstdint>

#include "parallel/exact/exact_flight.hpp"
#include "parallel/exact/exact_lists.hpp"
#include "parallel/exact/meeting_kernel.hpp"

namespace carom {

class ExactScan {
 public:
  ExactScan(const ExactField& field, const ExactLists& lists)
      : field_(&field),
        lists_(&lists),
        kernels_(choose_meeting_kernels(field.rules.gravity != 0.0, !field.disks->radius.empty())),
        frame_(frame_of(field)),
        fastest2_(field.fastest2) {}

  // The earliest event of disk i with a side or a listed disk, up to the horizon, all on the paths that they are on
  // now. lasting: one of its contacts lasts (ExactField::close), so that the next window may see other events.
  NextEvent earliest(std::uint32_t i, bool& lasting) const;

  // Somebody flies at this speed (v^2) from now on.
  void saw_speed(double v2) { fastest2_ = std::max(fastest2_, v2); }
  double fastest2() const { return fastest2_; }

 private:
  bool flies_far(const PathSegment& path) const {
    return !(std::max(fastest2_, path.vx * path.vx + path.vy * path.vy) <= field_->safe_speed2);
  }
  NextEvent earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far, bool& lasting) const;
  void meet(std::uint32_t i, std::uint32_t j, NextEvent& best) const;
  void see(std::uint32_t i, std::uint32_t j, double time, NextEvent& best) const;
  static MeetingFrame frame_of(const ExactField& field);

  const ExactField* field_;
  const ExactLists* lists_;
  MeetingKernels kernels_;
  MeetingFrame frame_;
  double fastest2_;  // largest v^2 so far
};

}  // namespace carom
