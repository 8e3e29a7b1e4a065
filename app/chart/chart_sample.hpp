// The result of one run of one method on one scene.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "app/chart/chart_scenes.hpp"
#include "core/scene/scene.hpp"

namespace carom::chart {

enum class Measure : std::uint8_t {
  cost,      // CPU seconds per disk and unit of time
  path,      // mean distance of disks from their positions by exact after `flight`, over the mean displacement
  rate,      // collisions of a disk per unit of time
  figure,    // pressure, cooling rate or spread (ChartScene::figure)
  energy,    // |E - E0| / E0 after `length`
  momentum,  // |P - P0| / sum |m v|
  overlap,   // largest overlap seen at the ends of steps, over the sum of the radii
  missed,    // collisions of exact within `flight` that the method does not have, over exact's
  spurious   // collisions of the method that exact does not have, over exact's
};
inline constexpr std::size_t measure_count = 9;

inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

struct Sample {
  Method method = Method::exact;
  double dt = 0.0;  // 0: exact
  std::array<double, measure_count> values{};
  std::string stopped{};  // why the method could not go on; then no value counts
  double& operator[](Measure m) { return values[static_cast<std::size_t>(m)]; }
  double operator[](Measure m) const { return values[static_cast<std::size_t>(m)]; }
};

// A point of a curve: the runs over which it is a mean.
struct Setting {
  Method method = Method::exact;
  double dt = 0.0;
  std::uint64_t seeds = 0;  // seeds 1 .. seeds
};

// Runs every setting that uses this seed from the same start, exact first (for Brownian motion at each dt, since exact
// needs a dt there). Throws PhysicsError if exact stops.
std::vector<Sample> measure_seed(const ChartScene& scene, std::uint64_t seed, const std::vector<Setting>& settings);

// A short run of the fluid with a given number of disks.
struct ShortRun {
  double cost = 0.0;   // CPU seconds per disk and unit of time, the least of `rounds` runs
  double steps = 0.0;  // steps, frames or windows per unit of time
};
ShortRun run_fluid(std::size_t disks, Method method, double dt, int rounds);

}  // namespace carom::chart
