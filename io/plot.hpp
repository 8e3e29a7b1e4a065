// Plots of a run as SVG, drawn by gnuplot.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/disks.hpp"

namespace carom {

// Velocities of up to 10 disks, those with the lowest ids, at every frame. Where a source emits disks, they fill up
// the ten as they come; a disk that a sink took has no further points.
struct VelocityRecord {
  struct Curve {
    DiskId id = 0;
    std::vector<double> t, vx, vy;
  };
  std::vector<Curve> curves;  // ascending ids
  double end = 0.0;           // time of the last frame
};
inline constexpr std::size_t most_velocity_curves = 10;

void record(VelocityRecord& record, const Disks& disks, double time);

struct EnergyRecord {
  std::vector<double> t, kinetic, potential, total;
};

// Both draw title and curves to an SVG file. They return false, and write nothing, where gnuplot is not installed.
// Throw RunError if gnuplot fails or the file cannot be written.
bool plot_velocity(const std::string& path, const std::string& title, const VelocityRecord& record);
bool plot_energy(const std::string& path, const std::string& title, const EnergyRecord& record);

}  // namespace carom
