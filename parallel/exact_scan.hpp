// The look around: whom a disk on a path meets first, of those in its list.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "parallel/exact_flight.hpp"
#include "parallel/exact_lists.hpp"
#include "parallel/sketch_kernel.hpp"

namespace carom {

// Events further apart than this share of a window cannot change their order through rounding: paths are known to
// `slack`, and where that shifts a contact by more than a quarter of this share the event does not count as clear.
inline constexpr double clear_share = 1e-5;

// Looks around disks, each on its path, at a time from which the future is wanted.
class ExactScan {
 public:
  ExactScan(ExactField& field, const ExactLists& lists)
      : field_(field), lists_(lists), sketched_(choose_sketch_kernel()), common_(common_frame(field)) {
    saw_speed(field.fastest2);
  }

  // The earliest event with a side or a listed disk, up to the horizon. Of neighbours that sketched(j) is true for the
  // sketch holds, and path_of(j) gives the path, or null for one that left; for others path_outside(j) does that,
  // once each.
  template <class Sketched, class PathOf, class PathOutside>
  NextEvent earliest(std::uint32_t i, const PathSegment& path, double from, Sketched&& sketched, PathOf&& path_of,
                     PathOutside&& path_outside);

  // When disks i and j meet on their paths at the slice's start; never, if that is beyond the horizon, or if slack
  // could shift it by much.
  double clear_meeting(std::uint32_t i, std::uint32_t j) const;

  // Somebody flies at this speed (v^2) from now on.
  void saw_speed(double v2) {
    if (!(v2 > fastest2_)) return;
    fastest2_ = v2;
    blur_ = field_.sketch_blur(v2);
    common_.slack = static_cast<float>(blur_ * field_.units.per_length);
  }

 private:
  // The earliest event so far, and a time that no other event can come before.
  struct Earliest {
    NextEvent best;
    double second;
  };

  bool flies_far(const PathSegment& path) const {
    return !(std::max(fastest2_, path.vx * path.vx + path.vy * path.vy) <= field_.safe_speed2);
  }
  NextEvent earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far) const;
  void meet(std::uint32_t i, const PathSegment& path, std::uint32_t j, const PathSegment& other, double soonest,
            Earliest& found) const;
  void meet_outside(std::uint32_t i, const PathSegment& path, double from, std::uint32_t j, const PathSegment& other,
                    Earliest& found) const;
  static SketchFrame common_frame(const ExactField& field);
  SketchFrame frame(std::uint32_t i, const PathSegment& path, double from) const;

  static std::uint32_t take_soonest(const float* soonest, std::uint32_t& candidates) {
    auto best = static_cast<std::uint32_t>(std::countr_zero(candidates));
    for (std::uint32_t rest = candidates & (candidates - 1U); rest != 0; rest &= rest - 1U) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
      if (soonest[k] < soonest[best]) best = k;
    }
    candidates &= ~(1U << best);
    return best;
  }

  ExactField& field_;
  const ExactLists& lists_;
  SketchKernel sketched_;
  SketchFrame common_;      // what the frames of all disks have in common
  double fastest2_ = -1.0;  // largest v^2 so far
  double blur_ = 0.0;       // how far sketches may be off then; length
};

// Two passes: a vector kernel finds those whose sketches come near enough and when at the soonest; the exact formula
// decides, the nearest first, until the others come too late.
template <class Sketched, class PathOf, class PathOutside>
NextEvent ExactScan::earliest(std::uint32_t i, const PathSegment& path, double from, Sketched&& sketched,
                              PathOf&& path_of, PathOutside&& path_outside) {
  const bool far = flies_far(path);
  Earliest found{earliest_at_sides(i, path, far), far || lists_.sides_near(i) != 0 ? -never : never};
  const SketchFrame own = frame(i, path, from);
  const ExactLists::Neighbours list = lists_.of(i);
  std::uint32_t disk[most_sketches];
  float soonest[most_sketches];
  for (std::uint32_t first = 0; first < list.count; first += most_sketches) {
    const std::uint32_t last = std::min(list.count, first + most_sketches);
    std::uint32_t n = 0;
    for (std::uint32_t k = first; k < last; ++k) {
      const std::uint32_t j = list.first[k];
      if (sketched(j)) {
        disk[n++] = j;
      } else if (const PathSegment* const other = path_outside(j); other != nullptr) {
        far ? meet(i, path, j, *other, -never, found) : meet_outside(i, path, from, j, *other, found);
      }
    }
    if (n == 0) continue;
    std::uint32_t candidates = n == 32 ? 0xffffffffU : (1U << n) - 1U;
    if (far) {
      std::fill_n(soonest, n, 0.0F);
    } else {
      candidates = sketched_(own, field_.sketch.data(), disk, n, soonest);
    }
    while (candidates != 0) {
      const std::uint32_t k = take_soonest(soonest, candidates);
      const double t = from + static_cast<double>(soonest[k]) * field_.units.time;
      if (t > std::min(found.best.time, field_.horizon)) {
        found.second = std::min(found.second, t);
        break;
      }
      const PathSegment* const other = path_of(disk[k]);
      if (other != nullptr) meet(i, path, disk[k], *other, t, found);
    }
  }
  found.best.clear = found.second - found.best.time > clear_share * field_.length;
  return found.best;
}

}  // namespace carom
