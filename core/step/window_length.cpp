#include "core/step/window_length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace carom {

namespace {

// Events for each disk in a window. With more, disks are advanced to a window's end less often; with fewer, fewer paths
// are stored.
constexpr double events_per_disk = 2.0;
constexpr double least_events = 32.0;
// Displacement of a disk of root mean square speed in the longest window, over the distance between neighbours.
constexpr double longest_travel = 1.0;
constexpr double few_disks = 64.0;
constexpr double shortest_share = 1.0 / 512.0;
constexpr double first_share = 1.0 / 32.0;
constexpr std::size_t disks_at_once = ExactSum::block;

}  // namespace

void SpeedTally::add(const Disks& d, const Domain& box, std::size_t begin, std::size_t end) {
  std::array<double, disks_at_once> v2;
  for (; begin < end; begin += std::min(disks_at_once, end - begin)) {
    const std::size_t count = std::min(disks_at_once, end - begin);
    const double* const vx = d.vx.data() + begin;
    const double* const vy = d.vy.data() + begin;
    for (std::size_t k = 0; k < count; ++k) v2[k] = vx[k] * vx[k] + vy[k] * vy[k];
    const std::span<const double> squares_of_speeds = std::span<const double>(v2).first(count);
    double largest = largest_size(squares_of_speeds);
    largest2 = std::max(largest2, largest);
    if (box.shear.acts()) {
      const double* const y = d.y.data() + begin;
      for (std::size_t k = 0; k < count; ++k) {
        const double ux = vx[k] - box.shear.flow(y[k], box.height);
        v2[k] = ux * ux + vy[k] * vy[k];
      }
      largest = largest_size(squares_of_speeds);
    }
    squares.add(squares_of_speeds, largest);
  }
}

void SpeedTally::add(const SpeedTally& other) {
  largest2 = std::max(largest2, other.largest2);
  squares.add(other.squares);
}

SpeedSummary summarise_speeds(const SpeedTally& tally, std::size_t disks) {
  if (disks == 0 || !std::isfinite(tally.largest2)) return {tally.largest2, tally.largest2};
  return {tally.largest2, tally.squares.value() / static_cast<double>(disks)};
}

double longest_window(const Scene& scene, const SpeedSummary& speeds, std::size_t disks) {
  // An inner wall moves by at most an eighth of the box in a window, so that it sweeps over few cells, and its images
  // stay in order.
  const double wall = fastest_inner_wall(scene);
  const double wander = wall > 0.0 ? 0.125 * std::min(scene.box.width, scene.box.height) / wall : HUGE_VAL;
  if (disks == 0) return wander;
  const double n = static_cast<double>(disks);
  const double spacing = std::sqrt(scene.box.width * scene.box.height / n);
  double side = wall;
  for (const SideMotion& motion : scene.box.motions) side = std::max(side, motion.largest_speed());
  // The images above a sheared box slide by at most an eighth of the width (time_to_sheared_contact).
  const double slide = scene.box.shear.acts() ? 0.125 * scene.box.width / std::abs(scene.box.shear.jump) : wander;
  // A fall through the spacing adds 2 g spacing to v^2, moving walls give their speed to disks at rest, and a shear
  // flow carries neighbours past each other at the shear rate times their distance.
  const double past = scene.box.shear.rate * spacing;
  const double speed = std::sqrt(speeds.mean2 + 2.0 * scene.physics.gravity.size * spacing + side * side + past * past);
  if (!(speed > 0.0)) return slide;
  return std::min(slide, longest_travel * spacing / speed * std::max(1.0, few_disks / n));
}

double next_window(double window, double elapsed, Count events, std::size_t disks) {
  if (events == 0) return elapsed < window ? window : 2.0 * window;
  const double aimed = std::max(least_events, events_per_disk * static_cast<double>(disks));
  const double wanted = elapsed * (aimed / static_cast<double>(events));
  return std::clamp(wanted, 0.5 * window, 2.0 * window);
}

double clamped_window(double window, double longest) {
  if (window < 0.0) return std::min(-window, longest);
  if (longest == HUGE_VAL) return longest;
  if (!(window > 0.0) || window == HUGE_VAL) window = first_share * longest;
  return std::clamp(window, least_window(longest), longest);
}

double least_window(double longest) {
  return shortest_share * longest;
}

Count most_paths(std::size_t disks) {
  constexpr Count few = 1U << 16;
  constexpr Count of_a_disk = 32;
  return std::max(few, of_a_disk * static_cast<Count>(disks));
}

}  // namespace carom
