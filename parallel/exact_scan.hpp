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

// How a neighbour looks; path is null for one that is left out.
struct Seen {
  const PathSegment* path = nullptr;
  std::uint32_t version = 0;
};

// One look around of disk i, on its path, at a time from which the future is wanted.
class ExactScan {
 public:
  ExactScan(const ExactField& field, const ExactLists& lists)
      : field_(field), lists_(lists), approaching_(choose_approach_kernel()), fastest2_(field.fastest2) {}

  // The earliest event with a side or a listed disk, up to the horizon. see(j) says how disk j is to be seen.
  template <class See>
  NextEvent earliest(std::uint32_t i, const PathSegment& path, double from, See&& see);

  // Somebody flies at this speed (v^2) from now on.
  void saw_speed(double v2) { fastest2_ = std::max(fastest2_, v2); }

 private:
  bool flies_far(const PathSegment& path) const {
    return !(std::max(fastest2_, path.vx * path.vx + path.vy * path.vy) <= field_.safe_speed2);
  }
  NextEvent earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far) const;
  void meet(std::uint32_t i, const PathSegment& path, std::uint32_t j, const Seen& seen, NextEvent& best) const;
  ApproachFrame frame(const PathSegment& path, double from) const;

  const ExactField& field_;
  const ExactLists& lists_;
  ApproachKernel approaching_;
  double fastest2_;  // largest v^2 so far
};

// Two passes: a test of signs leaves those that approach on paths that come near enough; the exact formula decides.
template <class See>
NextEvent ExactScan::earliest(std::uint32_t i, const PathSegment& path, double from, See&& see) {
  const double own_reach = field_.flight[i].radius + field_.slack;
  const bool far = flies_far(path);
  const ApproachFrame own = frame(path, from);
  NextEvent best = earliest_at_sides(i, path, far);
  const ExactLists::Neighbours list = lists_.of(i);
  ApproachBatch batch;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled up to n
  std::uint32_t disk[ApproachBatch::size];
  std::uint32_t version[ApproachBatch::size];
  for (std::uint32_t first = 0; first < list.count; first += ApproachBatch::size) {
    const std::uint32_t last = std::min(list.count, first + ApproachBatch::size);
    std::uint32_t n = 0;
    for (std::uint32_t k = first; k < last; ++k) {
      const std::uint32_t j = list.first[k];
      const Seen seen = see(j);
      if (seen.path == nullptr) continue;
      batch.path[n] = seen.path;
      batch.reach[n] = own_reach + field_.flight[j].radius;
      disk[n] = j;
      version[n] = seen.version;
      ++n;
    }
    std::uint32_t candidates = approaching_(own, batch, n);
    if (far) candidates = n == 32 ? 0xffffffffU : (1U << n) - 1U;
    for (; candidates != 0; candidates &= candidates - 1U) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(candidates));
      const double time_left = std::min(best.time, field_.horizon) - from;
      const bool too_late = batch.c[k] > -2.0 * std::min(batch.b[k], 0.0) * time_left * (1.0 + 1e-9);
      if (far || !too_late) meet(i, path, disk[k], {batch.path[k], version[k]}, best);
    }
  }
  return best;
}

}  // namespace carom
