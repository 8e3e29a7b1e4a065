// The look around: whom a disk on a path meets first, of those in its list.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "parallel/exact_flight.hpp"
#include "parallel/exact_lists.hpp"

namespace carom {

// How a neighbour looks; path is null for one that is left out.
struct Seen {
  const PathSegment* path = nullptr;
  std::uint32_t version = 0;
};

// Whom a disk may meet, with what bounds the time: the contact comes no earlier than c / (-2 b) after the look.
struct Candidate {
  const PathSegment* path;
  double b, c;
  std::uint32_t disk;
  std::uint32_t version;
};

// One look around of disk i, on its path, at a time from which the future is wanted.
class ExactScan {
 public:
  ExactScan(const ExactField& field, const ExactLists& lists) : field_(field), lists_(lists) {}

  // The earliest event with a side or a listed disk, up to the horizon. see(j) says how disk j is to be seen.
  template <class See>
  NextEvent earliest(std::uint32_t i, const PathSegment& path, double from, See&& see);

 private:
  static constexpr std::uint32_t batch = 32;

  bool flies_far(const PathSegment& path) const {
    return !(std::max(field_.fastest2, path.vx * path.vx + path.vy * path.vy) <= field_.safe_speed2);
  }
  NextEvent earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far) const;
  void meet(std::uint32_t i, const PathSegment& path, const Candidate& candidate, NextEvent& best) const;

  const ExactField& field_;
  const ExactLists& lists_;
};

// Two passes: a test of signs, without a branch, square root or division, leaves those that approach on paths that come
// near enough; the exact formula decides among them.
template <class See>
NextEvent ExactScan::earliest(std::uint32_t i, const PathSegment& path, double from, See&& see) {
  const ExactRules& rules = field_.rules;
  const double g = rules.gravity;
  const double own_reach = field_.flight[i].radius + field_.slack;
  const double width = rules.box.periodic_x() ? rules.box.width : 0.0;
  const double height = rules.box.periodic_y() ? rules.box.height : 0.0;
  const double half_width = width > 0.0 ? 0.5 * width : HUGE_VAL;
  const double half_height = height > 0.0 ? 0.5 * height : HUGE_VAL;
  const PathSegment p = carried_to(path, from, g);
  const bool far = flies_far(path);
  const double blur2 = (0.1 * field_.slack) * (0.1 * field_.slack);
  NextEvent best = earliest_at_sides(i, path, far);
  const ExactLists::Neighbours list = lists_.of(i);
  Candidate candidates[batch];  // NOLINT(cppcoreguidelines-pro-type-member-init): filled up to n
  for (std::uint32_t first = 0; first < list.count; first += batch) {
    const std::uint32_t last = std::min(list.count, first + batch);
    std::uint32_t n = 0;
    for (std::uint32_t k = first; k < last; ++k) {
      const std::uint32_t j = list.first[k];
      const Seen seen = see(j);
      if (seen.path == nullptr) continue;
      const PathSegment& q = *seen.path;
      const double s = from - q.start;
      double dx = (q.x + q.vx * s) - p.x;
      double dy = (q.y + (q.vy - 0.5 * g * s) * s) - p.y;
      dx -= dx > half_width ? width : (dx < -half_width ? -width : 0.0);
      dy -= dy > half_height ? height : (dy < -half_height ? -height : 0.0);
      const double dvx = q.vx - p.vx;
      const double dvy = (q.vy - g * s) - p.vy;
      const double near = own_reach + field_.flight[j].radius;
      const double a = dvx * dvx + dvy * dvy;
      const double b = dx * dvx + dy * dvy;
      const double c = dx * dx + dy * dy - near * near;
      // Not clearly receding, rounding allowed for. False for a path that is not a number.
      const bool near_enough = static_cast<int>(b * std::abs(b) <= blur2 * a) & static_cast<int>(b * b >= a * c);
      candidates[n] = {&q, b, c, j, seen.version};
      n += near_enough || far ? 1 : 0;
    }
    for (std::uint32_t k = 0; k < n; ++k) {
      const Candidate& candidate = candidates[k];
      const double time_left = std::min(best.time, field_.horizon) - from;
      const bool too_late = candidate.c > -2.0 * std::min(candidate.b, 0.0) * time_left * (1.0 + 1e-9);
      if (far || !too_late) meet(i, path, candidate, best);
    }
  }
  return best;
}

}  // namespace carom
