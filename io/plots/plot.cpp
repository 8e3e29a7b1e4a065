#include "io/plots/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/plots/gnuplot.hpp"

namespace carom {

namespace {

VelocityRecord::Curve* find_curve(VelocityRecord& record, DiskId id) {
  for (auto& curve : record.curves) {
    if (curve.id == id) return &curve;
  }
  return nullptr;
}

// Adds disks not seen before, lowest ids first, until there are ten. Ids only grow, so the order stays ascending.
void adopt_newcomers(VelocityRecord& record, const Disks& disks) {
  for (const std::size_t i : by_id(disks)) {
    if (record.curves.size() == most_velocity_curves) return;
    if (record.curves.empty() || disks.id[i] > record.curves.back().id)
      record.curves.push_back({disks.id[i], {}, {}, {}});
  }
}

// Quantiles of a larger sample would look the same.
constexpr std::size_t most_sampled = 20'000;

// One component of the velocities in a frame.
struct Component {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  std::vector<double> sample;

  void add(double velocity, bool sampled) {
    velocity += 0.0;  // -0 becomes 0: their text differs, and which one is the least would depend on the order
    least = std::min(least, velocity);
    greatest = std::max(greatest, velocity);
    if (sampled) sample.push_back(velocity);
  }

  std::array<double, velocity_levels> levels() {
    constexpr std::array<double, velocity_levels - 2> shares{0.05, 0.25, 0.5, 0.75, 0.95};
    std::sort(sample.begin(), sample.end());
    std::array<double, velocity_levels> levels{};
    levels.front() = least;
    levels.back() = greatest;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      levels[k + 1] = sample[static_cast<std::size_t>(std::lround(shares[k] * static_cast<double>(sample.size() - 1)))];
    }
    return levels;
  }
};

// Precondition: there are disks.
VelocityBand band_of(const DisksInPieces& disks) {
  Component x, y;
  const auto look = [&](std::size_t stride) {
    disks.visit([&](const Disks& d) {
      for (std::size_t i = 0; i < d.size(); ++i) {
        const bool sampled = d.id[i] % stride == 0;
        x.add(d.vx[i], sampled);
        y.add(d.vy[i], sampled);
      }
    });
  };
  look((disks.size() + most_sampled - 1) / most_sampled);
  if (x.sample.empty()) look(1);  // possible if all ids are between the multiples
  return {disks.time(), x.levels(), y.levels()};
}

// Adds the next points of the curves of these disks.
void add_points(VelocityRecord& record, const Disks& disks, double time) {
  if (record.curves.empty()) return;
  const DiskId last = record.curves.back().id;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    if (disks.id[i] > last) continue;
    if (auto* const curve = find_curve(record, disks.id[i])) {
      curve->t.push_back(time);
      curve->vx.push_back(disks.vx[i]);
      curve->vy.push_back(disks.vy[i]);
    }
  }
}

// The panel of one component of all disks: the bands, their edges with names, and the median.
Panel band_panel(const char* y_label, const VelocityRecord& record,
                 std::array<double, velocity_levels> VelocityBand::*component) {
  constexpr std::array<const char*, velocity_levels> names{"least", "5 %",  "25 %",    "median",
                                                           "75 %",  "95 %", "greatest"};
  constexpr std::array<const char*, velocity_levels / 2> shades{"#e1eef6", "#b5d5e9", "#7db5d8"};  // light to dark
  Panel panel{.y_label = y_label};
  std::vector<double> times;
  std::array<std::vector<double>, velocity_levels> levels;
  for (const VelocityBand& band : record.bands) {
    times.push_back(band.t);
    for (std::size_t k = 0; k < velocity_levels; ++k) levels[k].push_back((band.*component)[k]);
  }
  for (std::size_t k = 0; k < shades.size(); ++k) {
    panel.bands.push_back({times, levels[k], levels[velocity_levels - 1 - k], shades[k]});
  }
  const std::size_t median = velocity_levels / 2;
  panel.lines.push_back({names[median], times, levels[median]});
  for (std::size_t k = 0; k < velocity_levels; ++k) {
    if (k != median) panel.lines.push_back({names[k], times, levels[k], LineStyle::edge});
  }
  return panel;
}

// The total energy less the other two, which is that of rough disks' spins; empty if it is only rounding.
std::vector<double> rotational(const EnergyRecord& record) {
  std::vector<double> energy;
  bool there = false;
  for (std::size_t k = 0; k < record.t.size(); ++k) {
    const double rest = record.total[k] - record.kinetic[k] - record.potential[k];
    energy.push_back(rest);
    there = there || std::abs(rest) > 1e-9 * (std::abs(record.kinetic[k]) + std::abs(record.potential[k]));
  }
  return there ? energy : std::vector<double>{};
}

}  // namespace

void record(VelocityRecord& record, const DisksInPieces& disks) {
  record.end = disks.time();
  record.most = std::max(record.most, disks.size());
  if (disks.size() > 0) record.bands.push_back(band_of(disks));
  disks.visit([&](const Disks& some) {
    if (record.curves.size() < most_velocity_curves) adopt_newcomers(record, some);
    add_points(record, some, disks.time());
  });
}

bool plot_velocity(const std::string& path, const std::string& title, const VelocityRecord& record) {
  if (record.most > most_velocity_curves) {
    return draw_svg({heading(title, "velocities of all disks"),
                     "time t",
                     record.end,
                     {band_panel("vx", record, &VelocityBand::vx), band_panel("vy", record, &VelocityBand::vy)}},
                    path);
  }
  Figure figure{heading(title, "velocities"), "time t", record.end, {{"vx", {}}, {"vy", {}}}};
  for (const auto& curve : record.curves) {
    const std::string name = fmt::format("disk {}", curve.id);
    figure.panels[0].lines.push_back({name, curve.t, curve.vx});
    figure.panels[1].lines.push_back({name, curve.t, curve.vy});
  }
  return draw_svg(figure, path);
}

bool plot_energy(const std::string& path, const std::string& title, const EnergyRecord& record) {
  // From zero: otherwise the axis would zoom into the rounding errors of a constant total.
  Panel panel{.y_label = "energy", .from_zero = true, .wide_first = true};
  panel.lines.push_back({"total", record.t, record.total});
  panel.lines.push_back({"kinetic", record.t, record.kinetic});
  const bool has_potential =
      std::any_of(record.potential.begin(), record.potential.end(), [](double u) { return u != 0.0; });
  if (has_potential) panel.lines.push_back({"potential", record.t, record.potential});
  const std::vector<double> spins = rotational(record);
  if (!spins.empty()) panel.lines.push_back({"rotational", record.t, spins});
  return draw_svg({heading(title, "energy"), "time t", record.t.empty() ? 0.0 : record.t.back(), {panel}}, path);
}

}  // namespace carom
