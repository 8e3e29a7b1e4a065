// The lengths of the windows of the exact method. They follow from counts and speeds, never from clocks, and are the
// same in both engines. They decide how fast a run is; its physics changes only by rounding.
#pragma once

#include <cstddef>

#include "core/base/exact_sum.hpp"
#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Sums over the speeds of disks; they do not depend on the order in which disks are added.
struct SpeedTally {
  double largest2 = 0.0;  // v^2; length^2 / time^2
  ExactSum squares;       // of v^2, in a sheared box relative to the flow

  // Adds disks [begin, end).
  void add(const Disks& disks, const Domain& box, std::size_t begin, std::size_t end);
  void add(const SpeedTally& other);
};

struct SpeedSummary {
  double largest2 = 0.0;  // v^2; length^2 / time^2
  double mean2 = 0.0;     // mean of v^2, in a sheared box relative to the flow; not finite if largest2 is not
};

SpeedSummary summarise_speeds(const SpeedTally& tally, std::size_t disks);

// The longest useful window: in it the typical disk moves by the distance between neighbours. Fewer than 64 disks move
// proportionally further, so that a window of two disks still holds some tens of events. Infinity if nothing moves.
double longest_window(const Scene& scene, const SpeedSummary& speeds, std::size_t disks);

// The length of the next window, after one of length `elapsed` with `events` events (disk and wall): aims at two events
// for each disk, at least 32 in all, and changes by at most a factor of two. window: the planned length of the last
// window, before it was cut.
double next_window(double window, double elapsed, Count events, std::size_t disks);

// `window` (State::window, 0: the first one) clamped to [least_window, longest]. The lower bound only makes a window
// hold more events than planned, and keeps inelastic collapse from shrinking windows to nothing. A negative window
// stands for a length below least_window, used after a crowded window.
double clamped_window(double window, double longest);
double least_window(double longest);

// A window is crowded if one disk begins more than most_paths_of_disk paths in it, or all disks together more than
// most_paths; it is then begun again with a shorter length. So every window ends, and the stored paths, from which
// frames are computed, need at most 1.8 kB for each disk, or 4 MB.
inline constexpr std::uint32_t most_paths_of_disk = 1U << 15;
Count most_paths(std::size_t disks);

}  // namespace carom
