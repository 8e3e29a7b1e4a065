#include "io/plots/analysis_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/sample_mean.hpp"
#include "core/measure/analysis_curves.hpp"
#include "core/scene/scene_names.hpp"
#include "io/plots/gnuplot.hpp"

namespace carom {

namespace {

constexpr std::size_t pair_letters = 15;  // of a group's name, if two names are beside a line

// Leaves out values that are not numbers.
Line line_of(std::string name, const std::vector<double>& x, const std::vector<double>& y,
             LineStyle style = LineStyle::solid) {
  Line line{std::move(name), {}, {}, style};
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!std::isfinite(y[k])) continue;
    line.x.push_back(x[k]);
    line.y.push_back(y[k]);
  }
  return line;
}

Line level(std::string name, double end, double value) {
  return {std::move(name), {0.0, end}, {value, value}, LineStyle::dashed};
}

// Names the group to whose disks a quantity is restricted.
std::string heading_of(const Scene& scene, std::string subject) {
  if (!scene.analysis.group.empty()) subject += " of " + scene.analysis.group;
  return heading(scene.title, subject.c_str());
}

Figure pair_figure(const Scene& scene, const AnalysisRecord& record) {
  const BinnedCurve g = pair_correlation_curve(record.pairs, scene.analysis);
  Panel panel{.y_label = "g(r)", .from_zero = true};
  panel.lines.push_back(line_of(record.partial.empty() ? "g(r)" : "all disks", g.middle, g.value));
  for (const PartialCurve& part : partial_curves(record, scene.analysis)) {
    const auto name = [](const std::string& group) { return shortened(group, pair_letters); };
    panel.lines.push_back(line_of(fmt::format("{}, {}", name(part.group), name(part.other)), g.middle, part.g));
  }
  const double end = panel.lines[0].x.empty() ? scene.analysis.pairs.r_max : panel.lines[0].x.back();
  panel.lines.push_back(level("random", end, 1.0));
  return {heading_of(scene, "pair correlation"), "distance r", end, {panel}};
}

Figure speed_figure(const Scene& scene, const AnalysisRecord& record) {
  BinnedCurve measured = speed_curve(record, scene.analysis);
  BinnedCurve maxwell = maxwell_curve(scene.analysis);
  // Up to the largest speed seen.
  const double end = std::max(3.0, record.speeds.largest_seen);
  const auto shown = std::upper_bound(measured.middle.begin(), measured.middle.end(), end) - measured.middle.begin();
  const auto bins = std::max<std::size_t>(1, static_cast<std::size_t>(shown));
  for (BinnedCurve* const curve : {&measured, &maxwell}) {
    curve->middle.resize(bins);
    curve->value.resize(bins);
  }
  Panel panel{.y_label = "probability density", .from_zero = true};
  panel.lines.push_back(line_of("measured", measured.middle, measured.value, LineStyle::points));
  panel.lines.push_back(line_of("Maxwell", maxwell.middle, maxwell.value));
  return {heading_of(scene, "speeds"), "speed v, in units of sqrt(T / m)", measured.middle.back(), {panel}};
}

Figure density_figure(const Scene& scene, const AnalysisRecord& record) {
  const bool along_x = scene.analysis.density_along_x;
  const BinnedCurve packing = packing_curve(record.density, scene);
  Panel panel{.y_label = "packing fraction", .from_zero = true};
  panel.lines.push_back(line_of("local", packing.middle, packing.value));
  const SampleMean mean = sample_mean(packing.value);
  const double end = packing.middle.back();
  if (mean.samples > 0) panel.lines.push_back(level("mean", end, mean.mean));
  return {heading_of(scene, "density profile"), fmt::format("position {}", axis_names[along_x ? 0 : 1]), end, {panel}};
}

Figure series_figure(const Scene& scene, const AnalysisRecord& record, const std::vector<double>& values,
                     const char* subject, const char* label) {
  Panel panel{.y_label = label, .from_zero = true};
  panel.lines.push_back(line_of("samples", record.series.time, values));
  const Line samples = panel.lines[0];
  const double end = samples.x.empty() ? 0.0 : samples.x.back();
  const double mean = sample_mean(values, record.series.interval).mean;
  if (!samples.x.empty()) panel.lines.push_back({"mean", {samples.x.front(), end}, {mean, mean}, LineStyle::dashed});
  return {heading(scene.title, subject), "time t", end, {panel}};  // of all disks
}

Figure profile_figure(const Scene& scene, const AnalysisRecord& record) {
  const ProfileCurves curves = profile_curves(record.motion, scene);
  Panel velocity{.y_label = "velocity"}, temperature{.y_label = "temperature", .from_zero = true};
  velocity.lines.push_back(line_of("vx", curves.position, curves.vx));
  velocity.lines.push_back(line_of("vy", curves.position, curves.vy));
  temperature.lines.push_back(line_of("temperature", curves.position, curves.temperature));
  const bool along_x = scene.analysis.profile_along_x;
  return {heading_of(scene, "velocity and temperature"),
          fmt::format("position {}", axis_names[along_x ? 0 : 1]),
          curves.position.back(),
          {velocity, temperature},
          false,
          ""};
}

Figure structure_figure(const Scene& scene, const AnalysisRecord& record) {
  Panel panel{.y_label = "S(k)", .from_zero = true};
  double end = 0.0;
  const auto add = [&](const char* name, const StructureCurve& curve) {
    if (curve.k.empty()) return;
    panel.lines.push_back(line_of(name, curve.k, curve.s));
    end = std::max(end, curve.k.back());  // in a box that is taller than wide the last one is along x
  };
  add("along x", structure_along_x(record, scene));
  add("along y", structure_along_y(record, scene));
  panel.lines.push_back(level("ideal gas", end, 1.0));
  return {heading_of(scene, "structure factor"), "wave number k", end, {panel}, false, ""};
}

Figure order_figure(const Scene& scene, const AnalysisRecord& record) {
  const SampleSeries& series = record.series;
  Panel panel{.y_label = "psi6", .from_zero = true};
  panel.lines.push_back(line_of("around each disk", series.time, series.local_order));
  panel.lines.push_back(line_of("of all", series.time, series.global_order));
  return {heading_of(scene, "bond order"), "time t", series.time.empty() ? 1.0 : series.time.back(), {panel}};
}

Figure bond_figure(const Scene& scene, const AnalysisRecord& record) {
  const BinnedCurve curve = bond_correlation_curve(record, scene.analysis);
  Panel panel{.y_label = "g6(r)"};
  panel.lines.push_back(line_of("g6(r)", curve.middle, curve.value));
  const double end = panel.lines[0].x.empty() ? scene.analysis.bonds.r_max : panel.lines[0].x.back();
  return {heading_of(scene, "bond correlation"), "distance r", end, {panel}};
}

Figure memory_figure(const Scene& scene, const AnalysisRecord& record, const std::vector<double>& values,
                     const char* subject, const char* label) {
  const SampleSeries& series = record.series;
  Panel panel{.y_label = label};
  std::vector<double> since;
  for (const double t : series.time) since.push_back(t - series.time.front());
  panel.lines.push_back(line_of(label, since, values));
  return {heading_of(scene, subject), "time since the first sample", since.empty() ? 1.0 : since.back(), {panel}};
}

// A power law through a point of the curve, as far as it stays within the range of the curve's values.
Line slope(const char* name, const Line& curve, std::size_t through, double exponent) {
  const double x = curve.x[through], y = curve.y[through];
  const auto [least, greatest] = std::minmax_element(curve.y.begin(), curve.y.end());
  const auto at = [&](double height) {
    return std::clamp(x * std::pow(height / y, 1.0 / exponent), curve.x.front(), curve.x.back());
  };
  const double begin = at(*least), end = at(*greatest);
  const auto height = [&](double t) { return y * std::pow(t / x, exponent); };
  return {name, {begin, end}, {height(begin), height(end)}, LineStyle::guide};
}

Figure displacement_figure(const Scene& scene, const AnalysisRecord& record) {
  const SampleSeries& series = record.series;
  Panel panel{.y_label = "mean square displacement"};
  Line curve{"measured", {}, {}, LineStyle::solid};
  for (std::size_t k = 0; k < series.time.size(); ++k) {
    const double since = series.time[k] - series.time.front();
    if (!(since > 0.0 && series.displacement[k] > 0.0)) continue;
    curve.x.push_back(since);
    curve.y.push_back(series.displacement[k]);
  }
  const double end = curve.x.empty() ? 1.0 : curve.x.back();
  panel.lines.push_back(curve);
  if (curve.x.size() > 1) {
    panel.lines.push_back(slope("~ t^2", curve, 0, 2.0));
    panel.lines.push_back(slope("~ t", curve, curve.x.size() - 1, 1.0));
  }
  return {heading_of(scene, "displacement"), "time since the first sample", end, {panel}, true};
}

}  // namespace

bool draw_analysis(const std::string& folder, const Scene& scene, const AnalysisRecord& record) {
  const SampleSeries& series = record.series;
  const auto figure = [&](Quantity quantity) {
    switch (quantity) {
      case Quantity::pair_correlation:
        return pair_figure(scene, record);
      case Quantity::displacement:
        return displacement_figure(scene, record);
      case Quantity::speeds:
        return speed_figure(scene, record);
      case Quantity::density:
        return density_figure(scene, record);
      case Quantity::pressure:
        return series_figure(scene, record, series.pressure, "pressure", "pressure");
      case Quantity::profile:
        return profile_figure(scene, record);
      case Quantity::velocity_autocorrelation:
        return memory_figure(scene, record, series.autocorrelation, "velocity autocorrelation", "v(0) v(t)");
      case Quantity::structure_factor:
        return structure_figure(scene, record);
      case Quantity::bond_order:
        return order_figure(scene, record);
      case Quantity::bond_correlation:
        return bond_figure(scene, record);
      case Quantity::bond_autocorrelation:
        return memory_figure(scene, record, series.bond_autocorrelation, "bond autocorrelation", "g6(t)");
      case Quantity::collision_rate:
        break;
    }
    return series_figure(scene, record, series.collision_rate, "collision rate", "collisions per disk and unit time");
  };
  for (std::size_t k = 0; k < quantity_names.size(); ++k) {
    if (!scene.analysis.wanted[k]) continue;
    if (!draw_svg(figure(static_cast<Quantity>(k)), fmt::format("{}/{}.svg", folder, quantity_names[k]))) return false;
  }
  return true;
}

}  // namespace carom
