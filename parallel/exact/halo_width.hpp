// How wide the halos of the exact engine's parts are: as narrow as windows leave it.
#pragma once

#include <algorithm>
#include <cmath>

namespace carom {

// What a slice, or a window, needed of the halos: how far from the ends of parts the nearest ghost was that went
// elsewhere than its owner said, and the furthest one that must not. Lengths, or mean spacings.
struct HaloUse {
  double nearest = HUGE_VAL;
  double deepest = 0.0;

  void see(const HaloUse& other) {
    nearest = std::min(nearest, other.nearest);
    deepest = std::max(deepest, other.deepest);
  }
  double rest() const { return nearest - deepest; }
};

// What is missing beyond a halo reaches inwards by some spacings in a slice. Where that nearly comes to disks that
// concern a part's own, halos are made anew and wider; where it did not come near before the lists were due, narrower.
// In mean spacings.
class HaloWidth {
 public:
  // Width at first, in mean spacings; adapts: else it stays so.
  explicit HaloWidth(double first, bool adapts) : adapts_(adapts), spacings_(first) {}

  double spacings() const { return spacings_; }
  bool is_too_narrow() const { return adapts_ && least_seen_ < least_rest; }
  void see_window(const HaloUse& use) { least_seen_ = std::min(least_seen_, use.rest()); }
  void see_void() {
    least_seen_ = 0.0;
    widen();
  }
  // Halos are made anew.
  void adapt() {
    if (is_too_narrow()) widen();
    const bool is_wide = least_seen_ > least_rest + 2.0 * step && least_seen_ < HUGE_VAL;
    if (adapts_ && is_wide) spacings_ = std::max(least, spacings_ - step);
    least_seen_ = HUGE_VAL;
  }

 private:
  void widen() {
    if (adapts_) spacings_ = std::min(most, spacings_ + step);
  }

  // Wider than two skins and a radius: a disk that may come beyond an end is within that of it.
  static constexpr double least = 4.0;
  static constexpr double most = 32.0;
  static constexpr double least_rest = 1.5;
  static constexpr double step = 0.5;
  bool adapts_;
  double spacings_;
  double least_seen_ = HUGE_VAL;  // rest, since halos were made
};

}  // namespace carom
