// The bytes of a run's plots and page, which carom check does not make, and the memory of ffmpeg.
#pragma once

#include <string>
#include <vector>

#include "app/run/check_outputs.hpp"

namespace carom {

// Of a panel's axes in gnuplot's SVG, and of a plot of the analysis.
inline constexpr double panel_bytes = 17e3, analysis_plot_bytes = 1.5 * panel_bytes;

// The plots of `[output]` that a run draws. Brownian disks have no energies to plot.
std::vector<std::string> plots_over_frames(const Scene& scene);

// Adds the plots over frames of a run with this number of disks.
void add_plots(const Scene& scene, double disks, OutputForesight& f);

// Adds view.html with the time to make it, which reads the trajectory twice; numbers of disks and seconds from
// docs/viewer.md. shown: disks in a frame. Precondition: series.csv has been added, if there is one.
void add_page(const Scene& scene, double shown, OutputForesight& f);

// With libx264, which keeps some forty frames; a fit to 83 MB with 640 x 480 pixels, 140 with 1280 x 720, 1263 with
// 4096 x 4096 and 4547 with 8192 x 8192, on two cores. 0 if there is no movie.
double memory_of_ffmpeg(const Scene& scene);

}  // namespace carom
