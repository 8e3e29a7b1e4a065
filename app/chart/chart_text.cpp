#include "app/chart/chart_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/chart/chart_own.hpp"
#include "core/base/input_message.hpp"
#include "core/scene/scene_names.hpp"

namespace carom {

using chart::Curve;
using chart::Figure;
using chart::Measure;
using chart::Point;

namespace {

// An error, or the bound below which it is.
std::string error_text(const Point& p, Measure measure) {
  const chart::Mean& m = p[measure];
  const double size = std::abs(m.value);
  if (!std::isfinite(size)) return "-";
  if (chart::is_seen({p.dt, m.value, m.error})) return fmt::format("{:.1e}", size);
  const double below = chart::seen_errors * m.error;
  return below > chart::rounding_floor ? fmt::format("<{:.0e}", below) : "rounding";
}

const char* figure_name(Figure figure) {
  switch (figure) {
    case Figure::cooling:
      return "cooling";
    case Figure::spread:
      return "spread";
    default:
      return "pressure";
  }
}

// An upper bound of an error from the samples.
double bound_of(const Point& p, Measure measure) {
  const chart::Mean& m = p[measure];
  const double size = std::abs(m.value);
  return chart::is_seen({p.dt, m.value, m.error}) ? size : std::max(size, chart::seen_errors * m.error);
}

std::string cheapest_text(const chart::SceneResult& result, double error) {
  const Curve* best = nullptr;
  const Point* at = nullptr;
  for (const Curve& curve : result.curves) {
    for (const Point& p : curve.points) {
      if (!(bound_of(p, Measure::path) <= error) || (at != nullptr && at->cost <= p.cost)) continue;
      best = &curve;
      at = &p;
    }
  }
  if (best == nullptr) return fmt::format("  for a path error of {:g}: none of these steps is short enough\n", error);
  return fmt::format("  for a path error of {:g}: {}{}\n", error, name_of(best->method),
                     at->dt > 0.0 ? fmt::format(", dt = {:.3g}", at->dt) : "");
}

}  // namespace

std::string own_chart_text(const chart::SceneResult& result, const Scene& scene) {
  const double whole = static_cast<double>(chart::disks_that_move(scene)) * scene.run.t_end / result.unit;
  std::string text = fmt::format(
      "{}: errors against exact; paths to t = {:.3g}, collision rate and {} to t = {:.3g}\n"
      "  {:<10}{:<12}{:>6}{:>14}{:>10}{:>10}{:>10}\n",
      one_line(scene.file), result.scene.flight, figure_name(result.scene.figure), result.scene.length, "method", "dt",
      "seeds", "CPU to t_end", "path", "rate", figure_name(result.scene.figure));
  for (const Curve& curve : result.curves) {
    for (const Point& p : curve.points) {
      text += fmt::format("  {:<10}{:<12}{:>6}{:>12.3g} s{:>10}{:>10}{:>10}{}\n", name_of(curve.method),
                          p.dt > 0.0 ? fmt::format("{:.4g}", p.dt) : "", p.seeds, p.cost * whole,
                          error_text(p, Measure::path), error_text(p, Measure::rate), error_text(p, Measure::figure),
                          p.dt > 0.0 && p.dt == scene.run.dt ? "  the scene's dt" : "");
    }
  }
  for (const chart::Stop& stop : result.stops) {
    text += fmt::format("  {:<10}{:<12.4g}stops: {}\n", name_of(stop.method), stop.dt, stop.why);
  }
  text += "cheapest\n";
  for (const double error : {1e-1, 1e-2, 1e-3, 1e-4}) text += cheapest_text(result, error);
  return text;
}

}  // namespace carom
