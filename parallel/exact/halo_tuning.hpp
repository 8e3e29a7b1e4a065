// The width of the halos of the exact engine's parts and the number of slices of a window, adapted to the last windows.
#pragma once

#include <algorithm>
#include <cmath>

namespace carom {

// What a slice, or a window, needed of the halos. nearest: the least distance beyond its part's end of a ghost that
// moved otherwise than in its owner. deepest: the largest such distance of a ghost that had to move as in its owner.
// Lengths, or mean spacings.
struct HaloUse {
  double nearest = HUGE_VAL;
  double deepest = 0.0;

  void see(const HaloUse& other) {
    nearest = std::min(nearest, other.nearest);
    deepest = std::max(deepest, other.deepest);
  }
  double rest() const { return nearest - deepest; }
};

// In a slice the error that begins at the halo's outer end, where disks are missing, spreads inwards by some spacings.
// If it nearly reaches ghosts that concern a part's own disks, wider halos are made. If it reaches them the window is
// void, and the number of slices is doubled as well: disks are dense then, and an event soon affects many of them. If
// it stays far away until the lists are due, there are fewer slices again, or narrower halos. With more slices than
// needed, threads wait for the slowest one more often.
class HaloTuning {
 public:
  // spacings: the width of halos at first, in mean spacings. adapts: if false, width and slices stay as they are.
  explicit HaloTuning(double spacings, bool adapts) : adapts_(adapts), spacings_(spacings) {}

  double spacings() const { return spacings_; }
  int slices() const { return slices_; }
  bool is_too_narrow() const { return adapts_ && least_seen_ < least_rest; }
  void see_window(const HaloUse& use) { least_seen_ = std::min(least_seen_, use.rest()); }
  void see_void() {
    least_seen_ = 0.0;
    if (adapts_) slices_ = std::min(most_slices, 2 * slices_);
  }
  // To be called when halos are made anew.
  void adapt() {
    const bool is_wide = adapts_ && least_seen_ > least_rest + 2.0 * step && least_seen_ < HUGE_VAL;
    if (is_too_narrow()) spacings_ = std::min(widest, spacings_ + step);
    if (is_wide && slices_ == least_slices) spacings_ = std::max(narrowest, spacings_ - step);
    if (is_wide) slices_ = std::max(least_slices, slices_ / 2);
    least_seen_ = HUGE_VAL;
  }

 private:
  // In mean spacings. The narrowest halo is wider than two skins and a radius, so any disk that may come beyond an end
  // is within the halo's width of it.
  static constexpr double narrowest = 4.0;
  static constexpr double widest = 32.0;
  static constexpr double step = 0.5;
  static constexpr double least_rest = 1.0;
  static constexpr int least_slices = 4;
  static constexpr int most_slices = 64;
  bool adapts_;
  double spacings_;
  int slices_ = least_slices;
  double least_seen_ = HUGE_VAL;  // of rest(), since halos were made
};

}  // namespace carom
