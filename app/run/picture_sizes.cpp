#include "app/run/picture_sizes.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/drawn_velocities.hpp"
#include "io/movie/frame.hpp"
#include "io/movie/movie.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/plots/plot.hpp"
#include "io/view/view_page.hpp"
#include "run/recordings/run_view.hpp"

namespace carom {

namespace {

// Bytes in gnuplot's SVG: of a curve's name and style, and of a point.
constexpr double curve_bytes = 450.0, point_bytes = 15.0;

// The bytes of a file, as foreseen so far; 0 if the run does not write it.
double foreseen_bytes(const OutputForesight& f, std::string_view name) {
  const auto file = std::find_if(f.files.begin(), f.files.end(), [&](const auto& some) { return some.first == name; });
  return file == f.files.end() ? 0.0 : file->second;
}

// Bytes of view.html besides its disks: of the viewer; of the run's head; of each frame, its time and its share of the
// blocks' heads; and of the plots, whose numbers have five digits and so half the bytes of series.csv, and are 20000 at
// most.
double page_bytes_without_disks(const OutputForesight& f) {
  constexpr double head_bytes = 1000.0, frame_bytes = 8.0, series_share = 0.5, most_of_series = 100e3;
  return static_cast<double>(std::string_view(viewer_page).size()) + head_bytes +
         frame_bytes * static_cast<double>(f.frames) +
         std::min(most_of_series, series_share * foreseen_bytes(f, "series.csv"));
}

// The form of a plot over frames: the number of panels, and of curves in all of them.
struct PlotForm {
  double panels, curves;
};

// Two components of the velocity, each with a curve for each disk, or with the edges of bands and the lines along them.
// The energy: total, kinetic, and its other parts.
PlotForm plot_form(const Scene& scene, std::string_view plot, double disks) {
  if (plot != "velocity") {
    return {1.0, 2.0 + static_cast<double>(scene.physics.gravity.acts()) +
                     static_cast<double>(scene.physics.surfaces.are_rough())};
  }
  constexpr double bands = velocity_levels / 2;
  const bool has_bands = disks > static_cast<double>(most_velocity_curves);
  return {2.0, 2.0 * (has_bands ? 2.0 * bands + static_cast<double>(velocity_levels) : disks)};
}

}  // namespace

std::vector<std::string> plots_over_frames(const Scene& scene) {
  std::vector<std::string> plots = scene.output.plots;
  if (velocities_are_drawn(scene)) std::erase(plots, "energy");
  return plots;
}

void add_page(const Scene& scene, double shown, OutputForesight& f) {
  constexpr double disk_bytes = 2.0, xyz_s = 1.7e-6, h5md_s = 0.4e-6;
  const double disk_frames = shown * static_cast<double>(f.frames);
  const auto most = static_cast<double>(ViewWork{}.most_bytes);
  f.files.emplace_back("view.html", std::min(most, page_bytes_without_disks(f) + disk_bytes * disk_frames));
  f.files_s += disk_frames * (scene.output.trajectory == TrajectoryFormat::xyz ? xyz_s : h5md_s);
}

void add_plots(const Scene& scene, double disks, OutputForesight& f) {
  const auto points = static_cast<double>(points_drawn(f.frames));
  for (const std::string& plot : plots_over_frames(scene)) {
    const PlotForm form = plot_form(scene, plot, disks);
    f.files.emplace_back(plot + ".svg", panel_bytes * form.panels + (curve_bytes + point_bytes * points) * form.curves);
  }
}

double memory_of_ffmpeg(const Scene& scene) {
  constexpr double at_least = 60e6, pixel_bytes = 70.0;
  if (!scene.output.movie || !finds_ffmpeg()) return 0.0;
  const FrameLayout layout = frame_layout(frame_style(scene, scene.output.look, {}));
  return at_least + pixel_bytes * static_cast<double>(layout.width) * static_cast<double>(layout.height);
}

}  // namespace carom
