// How long the windows of the exact method are. Lengths follow from counts and speeds, the same in both engines, never
// from clocks; they change how fast a run is, its physics only by rounding.
#pragma once

#include <cstddef>

#include "core/base/exact_sum.hpp"
#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// What the disks' speeds say. Neither depends on the order in which disks are added.
struct SpeedTally {
  double largest2 = 0.0;  // v^2; length^2 / time^2
  ExactSum squares;       // of v^2, in a sheared box relative to the flow

  // Disks [begin, end).
  void add(const Disks& disks, const Domain& box, std::size_t begin, std::size_t end);
  void add(const SpeedTally& other);
};

struct SpeedSummary {
  double largest2 = 0.0;  // v^2; length^2 / time^2
  double mean2 = 0.0;     // mean of v^2, relative to a flow; not finite where largest2 is not
};

SpeedSummary summarise_speeds(const SpeedTally& tally, std::size_t disks);

// Longest window that pays: the typical disk crosses the distance to its neighbours, and 64 disks or fewer go
// proportionally further, so that a window of two disks still holds some tens of events. Infinity when nothing moves.
double longest_window(const Scene& scene, const SpeedSummary& speeds, std::size_t disks);

// The window after one that took `elapsed` and saw `events` (disk and wall): aims at two events a disk, and at 32 where
// disks are few, by at most a factor of two at a time. window: the length that was meant before anything cut it short.
double next_window(double window, double elapsed, Count events, std::size_t disks);

// `window` (0: the first one) kept within least_window and longest. A window that is longer than its events ask for
// only holds more of them, so that inelastic collapse cannot shrink windows to nothing. Negative: a length below that,
// since a longer window was crowded.
double clamped_window(double window, double longest);
double least_window(double longest);

// A window is crowded when a disk begins more than most_paths_of_disk paths in it, or all disks together more than
// most_paths; it is then made shorter. So every window ends, and the paths that frames are read from stay within 1.8 kB
// a disk, or 4 MB.
inline constexpr std::uint32_t most_paths_of_disk = 1U << 15;
Count most_paths(std::size_t disks);

}  // namespace carom
