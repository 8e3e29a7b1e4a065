// The look around: whom a disk on a path meets first, of those in its list.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "parallel/approach_kernel.hpp"
#include "parallel/exact_flight.hpp"
#include "parallel/exact_lists.hpp"

namespace carom {

// One look around of disk i, on its path, at a time from which the future is wanted.
class ExactScan {
 public:
  ExactScan(const ExactField& field, const ExactLists& lists)
      : field_(&field),
        lists_(&lists),
        approaching_(choose_approach_kernel()),
        approaching_flights_(choose_flight_kernel()),
        fastest2_(field.fastest2) {}

  // The earliest event with a side or a listed disk, up to the horizon; its other_version is left to the caller.
  // see(j) says on which path disk j is to be seen, null: not at all.
  template <class See>
  NextEvent earliest(std::uint32_t i, const PathSegment& path, double from, See&& see) const;

  // The same for a disk on its own path that sees everybody so.
  NextEvent earliest(std::uint32_t i, double from) const;

  // Somebody flies at this speed (v^2) from now on.
  void saw_speed(double v2) { fastest2_ = std::max(fastest2_, v2); }

 private:
  bool flies_far(const PathSegment& path) const {
    return !(std::max(fastest2_, path.vx * path.vx + path.vy * path.vy) <= field_->safe_speed2);
  }
  NextEvent earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far) const;
  void meet(std::uint32_t i, const PathSegment& path, std::uint32_t j, const PathSegment& other, NextEvent& best) const;
  ApproachFrame frame(const PathSegment& path, double from) const;
  template <class PathOf>
  void meet_candidates(std::uint32_t i, const PathSegment& path, double from, std::uint32_t candidates,
                       const double* least, const std::uint32_t* disk, PathOf&& path_of, NextEvent& best) const;

  const ExactField* field_;
  const ExactLists* lists_;
  ApproachKernel approaching_;
  FlightKernel approaching_flights_;
  double fastest2_;  // largest v^2 so far
};

// The likely first one first: it spares most of the others.
template <class PathOf>
void ExactScan::meet_candidates(std::uint32_t i, const PathSegment& path, double from, std::uint32_t candidates,
                                const double* least, const std::uint32_t* disk, PathOf&& path_of,
                                NextEvent& best) const {
  while (candidates != 0) {
    auto first = static_cast<std::uint32_t>(std::countr_zero(candidates));
    for (std::uint32_t left = candidates & (candidates - 1U); left != 0; left &= left - 1U) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
      if (least[k] < least[first]) first = k;
    }
    const double latest = (std::min(best.time, field_->horizon) - from) * (1.0 + 1e-9);
    if (least[first] > latest) break;
    candidates &= ~(1U << first);
    meet(i, path, disk[first], path_of(first), best);
  }
}

// Two passes: a test of signs leaves those that approach on paths that come near enough; the exact formula decides.
template <class See>
NextEvent ExactScan::earliest(std::uint32_t i, const PathSegment& path, double from, See&& see) const {
  const bool far = flies_far(path);
  const ApproachFrame own = frame(path, from);
  const double own_reach = field_->flight[i].radius + field_->slack;
  NextEvent best = earliest_at_sides(i, path, far);
  static_assert(ExactLists::chunk < ApproachBatch::size);
  ApproachBatch batch;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled up to n
  std::uint32_t disk[ApproachBatch::size];
  lists_->see_neighbours(i, [&](const std::uint32_t* near, std::uint32_t count) {
    std::uint32_t n = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const PathSegment* const seen = see(near[k]);
      if (seen == nullptr) continue;
      batch.path[n] = seen;
      batch.reach[n] = own_reach + field_->flight[near[k]].radius;
      disk[n++] = near[k];
    }
    const std::uint32_t candidates = approaching_(own, batch, n);
    const auto path_of = [&](std::uint32_t k) -> const PathSegment& { return *batch.path[k]; };
    if (far) {
      for (std::uint32_t k = 0; k < n; ++k) meet(i, path, disk[k], path_of(k), best);
    } else {
      meet_candidates(i, path, from, candidates, batch.least, disk, path_of, best);
    }
  });
  return best;
}

}  // namespace carom
