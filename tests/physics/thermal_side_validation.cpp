// Thermal sides compared with theory: the heat flow of a free molecular gas, and conduction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/engine_run.hpp"

namespace carom {
namespace {

using test::run_by_engine;

const std::string folder = CAROM_SOURCE_DIR "/scenes/";

// Disks that meet only walls carry N (3 / 2) (T1 - T2) in each round trip, whose mean duration is L sqrt(pi m / 2)
// (T1^-1/2 + T2^-1/2).
TEST(ThermalSide, GivesTheHeatFlowOfAFreeMolecularGas) {
  const Scene scene = load_scene(folder + "knudsen_gap.toml", {{"run.t_end", "4000"}});
  const State end = run_by_engine(scene, initial_state(scene));
  const double gap = scene.box.width - 2.0 * end.disks.common_radius;
  const double t1 = scene.box.temperature(Side::left);
  const double t2 = scene.box.temperature(Side::right);
  const double trip = gap * std::sqrt(std::numbers::pi / 2.0) * (1.0 / std::sqrt(t1) + 1.0 / std::sqrt(t2));
  const double flow = static_cast<double>(end.disks.size()) * 1.5 * (t1 - t2) / trip;
  EXPECT_NEAR(end.counters.side_energy[0] / end.time / flow, 1.0, 0.03);
  EXPECT_NEAR(-end.counters.side_energy[1] / end.time / flow, 1.0, 0.03);
  EXPECT_LT(end.counters.collisions * 50, end.counters.wall_collisions);
}

// The mean temperature and density in slabs along x, over a run.
struct Slabs {
  std::vector<double> energy, count;
  double width;

  Slabs(std::size_t n, double box_width) : energy(n), count(n), width(box_width / static_cast<double>(n)) {}
  void add(const Disks& d) {
    for (std::size_t i = 0; i < d.size(); ++i) {
      const auto k = std::min(static_cast<std::size_t>(d.x[i] / width), energy.size() - 1);
      energy[k] += 0.5 * d.mass_of(i) * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
      count[k] += 1.0;
    }
  }
  double temperature(std::size_t k) const { return energy[k] / count[k]; }
};

// Conductivity of hard disks by Enskog's theory (Gass 1971): that of the dilute gas, 2 sqrt(T / (pi m)) / d times
// 1.0292 (third Sonine approximation), times b rho (1 / y + 3 / 2 + 0.8718 y), with y = b rho chi, b = pi d^2 / 2.
double conductivity(double temperature, double density, double diameter) {
  const double dilute = 1.0292 * 2.0 * std::sqrt(temperature / std::numbers::pi) / diameter;
  const double packing = 0.25 * std::numbers::pi * diameter * diameter * density;
  const double b = 2.0 * packing;
  const double y = b * (1.0 - 7.0 * packing / 16.0) / ((1.0 - packing) * (1.0 - packing));
  return dilute * b * (1.0 / y + 1.5 + 0.8718 * y);
}

// The heat flow is the conductivity times the slope of the temperature; at the walls the temperature jumps towards that
// of the gas. Runs an eighth as long give heat flows that differ by a tenth.
TEST(ThermalSide, ConductsHeatAsEnskogsTheorySays) {
  const Scene scene = load_scene(folder + "heat_conduction.toml", {{"run.t_end", "12000"}});
  const double begin = 150.0;
  Slabs slabs(12, scene.box.width);
  double heat_before[2] = {0.0, 0.0};
  double from = 0.0;
  const State end = run_by_engine(scene, initial_state(scene), [&](const State& s) {
    if (s.time < begin) {
      std::copy_n(s.counters.side_energy, 2, heat_before);
      from = s.time;
    } else {
      slabs.add(s.disks);
    }
  });
  const double in = (end.counters.side_energy[0] - heat_before[0]) / (end.time - from);
  const double out = (heat_before[1] - end.counters.side_energy[1]) / (end.time - from);
  EXPECT_NEAR(in / out, 1.0, 0.05);
  const double flow = 0.5 * (in + out) / scene.box.height;
  // Only slabs at least four mean free paths away from the walls.
  const double slope = (slabs.temperature(2) + slabs.temperature(3) - slabs.temperature(8) - slabs.temperature(9)) /
                       (2.0 * 6.0 * slabs.width);
  double predicted = 0.0;
  double total = 0.0;
  for (const double c : slabs.count) total += c;
  for (std::size_t k = 3; k < 9; ++k) {
    const double density =
        static_cast<double>(end.disks.size()) * slabs.count[k] / (total * slabs.width * scene.box.height);
    predicted += conductivity(slabs.temperature(k), density, 2.0 * end.disks.common_radius) / 6.0;
  }
  EXPECT_NEAR(flow / slope / predicted, 1.0, 0.08);
  EXPECT_LT(slabs.temperature(0), 1.97);
  EXPECT_GT(slabs.temperature(11), 1.03);
  EXPECT_GT(slabs.temperature(0), slabs.temperature(3));
  EXPECT_GT(slabs.temperature(8), slabs.temperature(11));
}

}  // namespace
}  // namespace carom
