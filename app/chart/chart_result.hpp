// The numbers of the chart: the results of all runs, summed up over seeds.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/chart/chart_fit.hpp"
#include "app/chart/chart_sample.hpp"

namespace carom::chart {

inline constexpr std::array<std::string_view, measure_count> measure_names{
    "cost", "path", "rate", "figure", "energy", "momentum", "overlap", "missed", "spurious"};

// A mean over seeds with its standard error. Rate and figure are relative differences from exact's with the same
// starts, with their sign; the others are as measured. NaN if the scene does not define it.
struct Mean {
  double value = 0.0;
  double error = 0.0;
};

struct Point {
  double dt = 0.0;  // 0: exact, which has no step
  std::uint64_t seeds = 0;
  double cost = 0.0;  // CPU seconds per disk and unit of `ChartResult::unit`, the least of all seeds
  std::array<Mean, measure_count> errors{};
  const Mean& operator[](Measure m) const { return errors[static_cast<std::size_t>(m)]; }
};

struct Curve {
  Method method = Method::exact;
  std::vector<Point> points;  // in order of falling dt
  std::array<std::optional<OrderFit>, measure_count> fits{};
  const std::optional<OrderFit>& fit(Measure m) const { return fits[static_cast<std::size_t>(m)]; }
};

// A step with which the method stopped in one of the runs: there is no point for it.
struct Stop {
  Method method = Method::exact;
  double dt = 0.0;
  std::string why;  // the reason in the first such run
};

struct SceneResult {
  ChartScene scene;
  double unit = 1.0;          // unit of time in costs: exact's mean free time, or diameter^2 / D for Brownian motion
  double figure = 0.0;        // exact's value of the scene's figure
  std::vector<Curve> curves;  // rollback, pairwise, exact
  std::vector<Stop> stops;
};

// A run of the fluid with this number of disks.
struct CrowdPoint {
  std::size_t disks = 0;
  Method method = Method::exact;
  double dt = 0.0;      // 0: exact
  double cost = 0.0;    // per disk and mean free time
  double frames = 0.0;  // steps needed to advance by dt; 0: exact
};

struct ChartResult {
  std::vector<SceneResult> scenes;
  std::vector<CrowdPoint> crowd;
};

// The number of runs: steps are longest_step / factor^k for the powers k listed.
struct Effort {
  std::string name;
  std::vector<int> powers;
  std::uint64_t most_seeds = 0;   // for the long steps, up to power 4: each further power halves the number
  std::uint64_t least_seeds = 0;  // for the shortest
  std::vector<std::size_t> crowds;
  double scale = 1.0;  // of flights and lengths; below 1 for tests
};

Effort full_effort();
Effort quick_effort();
Effort tiny_effort();  // takes seconds; its numbers are of no use, except for tests
// The effort for a user's own scene, whose size is not known in advance: without crowds, and with fewer seeds.
Effort for_own(Effort effort);

// The predicted order in dt (docs/methods.md); none if dt does not matter or there is no prediction. The error is a
// share Gamma dt of all collisions, those of disks that collide twice in a step: first order. Brownian disks of speed
// sqrt(2 D / dt) have Gamma dt of order 1/2.
std::optional<double> predicted_order(const ChartScene& scene, Method method, Measure measure);

// Called with the completed share of the work.
using Watch = std::function<void(double share)>;

// Measures these scenes, without crowds.
ChartResult measure_scenes(const std::vector<ChartScene>& scenes, const Effort& effort, int threads,
                           const Watch& watch);

// Measures the whole chart on `threads` threads, with one run a thread. Reads the clock only to measure costs.
ChartResult measure_chart(const Effort& effort, int threads, const Watch& watch);

// Sums up the samples of one scene: samples[seed][setting].
SceneResult summed_up(const ChartScene& scene, const std::vector<std::vector<Sample>>& samples);

}  // namespace carom::chart
