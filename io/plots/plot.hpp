// Plots of a run as SVG, drawn by gnuplot.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/disks/disks_in_pieces.hpp"

namespace carom {

// The distribution of the velocities of all disks in a frame: for each component the least value, the quantiles 5, 25,
// 50, 75 and 95 %, and the greatest. If there are very many disks, the quantiles are those of every k-th disk by id.
inline constexpr std::size_t velocity_levels = 7;
struct VelocityBand {
  double t = 0.0;
  std::array<double, velocity_levels> vx{}, vy{};
};

// Velocities of up to 10 disks, those with the lowest ids, in every frame. If a source emits disks, they complete the
// ten as they come; a disk that a sink took has no further points. If any frame has more disks, the plot shows the
// bands instead of the curves.
struct VelocityRecord {
  struct Curve {
    DiskId id = 0;
    std::vector<double> t, vx, vy;
  };
  std::vector<Curve> curves;  // ascending ids
  double end = 0.0;           // time of the last frame
  std::vector<VelocityBand> bands;
  Count most = 0;  // largest number of disks in a frame
};
inline constexpr std::size_t most_velocity_curves = 10;

void record(VelocityRecord& record, const DisksInPieces& disks);
inline void record(VelocityRecord& velocities, const Disks& disks, double time) {
  record(velocities, WholeDisks(disks, time));
}

struct EnergyRecord {
  std::vector<double> t, kinetic, potential, total;
};

// Both draw title and curves to an SVG file. They return false, and write nothing, if gnuplot is not installed. They
// throw RunError if gnuplot fails or the file cannot be written.
bool plot_velocity(const std::string& path, const std::string& title, const VelocityRecord& record);
bool plot_energy(const std::string& path, const std::string& title, const EnergyRecord& record);

}  // namespace carom
