#include "app/chart/chart_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/scene_names.hpp"

namespace carom {

using chart::ChartResult;
using chart::Curve;
using chart::Figure;
using chart::Measure;
using chart::Point;
using chart::SceneResult;

namespace {

constexpr const char* cost_label = "CPU s / disk / mean free time";
constexpr const char* brownian_label = "CPU s / disk / (σ²/D)";
constexpr const char* caption =
    "Bars: standard error over seeds. Open symbols: nothing seen; the error is below (two standard errors) or "
    "rounding. "
    "p: fitted order in dt ± its standard error (predicted).\n"
    "Exact is compared with itself, started one rounding away; its rates are drawn at their own noise, which is what "
    "this chart can resolve.";

// For one scene: shorter lines, since the page is narrower.
constexpr const char* own_caption =
    "Bars: standard error over seeds. Open symbols: below twice that, or rounding. p: fitted order in dt (predicted).\n"
    "Exact is compared with itself, started one rounding away; its rates are drawn at their own noise.";
constexpr const char* alike_caption =
    "One run each, as the scene starts alike whatever the seed. Open symbols: no error, or rounding.\n"
    "p: fitted order in dt (predicted). Exact is compared with itself, started one rounding away.";

// A smaller error counts as none; axes end here.
constexpr double no_error = 1e-17;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// A little more than the range, so that no symbol is on an axis.
Range widened(const Range& range) {
  return {range.low / 1.8, range.high * 1.8};
}

// The method's name and its fitted order.
std::string order_text(const SceneResult& result, const Curve& curve, Measure measure) {
  const std::string name(name_of(curve.method));
  const auto& fit = curve.fit(measure);
  const auto predicted = chart::predicted_order(result.scene, curve.method, measure);
  if (!fit) return name;
  std::string text = fmt::format("{}  p = {:.2f} ± {:.2f}", name, fit->order, fit->order_error);
  if (predicted) text += fmt::format(" ({:g})", *predicted);
  return text;
}

LogPoint point_of(const Point& p, Measure measure, double floor) {
  const chart::Mean& m = p[measure];
  const double size = std::abs(m.value);
  if (chart::is_seen({p.dt, m.value, m.error}) || size > chart::rounding_floor) {
    const bool bound = size <= chart::seen_errors * m.error;
    const double bound_at = chart::seen_errors * m.error;
    return bound ? LogPoint{p.cost, std::max(bound_at, floor), 0.0, true} : LogPoint{p.cost, size, m.error, false};
  }
  // The error is at most rounding.
  const bool rates = measure == Measure::rate || measure == Measure::figure;
  return {p.cost, std::max({size, rates ? chart::seen_errors * m.error : size, floor}), 0.0, true};
}

// One error of one scene; a second measure is drawn faint.
LogPanel error_panel(const SceneResult& result, std::vector<Measure> measures, const std::string& title) {
  const bool brownian = result.scene.figure == Figure::spread;
  LogPanel panel;
  panel.title = title;
  panel.x_label = brownian ? brownian_label : cost_label;
  Range y;
  for (const Curve& curve : result.curves) {
    for (std::size_t k = 0; k < measures.size(); ++k) {
      LogCurve drawn{static_cast<int>(curve.method),
                     k == 0 ? order_text(result, curve, measures[k]) : "",
                     {},
                     k > 0,
                     curve.method == Method::exact && !curve.fit(measures[k])};
      for (const Point& p : curve.points) {
        if (!std::isfinite(p[measures[k]].value)) continue;
        drawn.points.push_back(point_of(p, measures[k], no_error));
        y.add(drawn.points.back().y);
      }
      if (drawn.points.empty()) continue;
      panel.curves.push_back(std::move(drawn));
    }
  }
  if (y.high == 0.0) y = {1e-4, 1.0};
  panel.y_low = std::pow(10.0, std::floor(std::log10(y.low / 1.5)));
  panel.y_high = std::pow(10.0, std::ceil(std::log10(y.high * 1.5)));
  return panel;
}

// Panels whose costs have the same meaning share an axis.
void share_costs(const std::vector<LogPanel*>& panels) {
  Range x;
  for (const LogPanel* panel : panels) {
    for (const LogCurve& curve : panel->curves) {
      for (const LogPoint& p : curve.points) x.add(p.x);
    }
  }
  if (x.high == 0.0) x = {1e-7, 1e-4};
  x = widened(x);
  for (LogPanel* panel : panels) {
    panel->x_low = x.low;
    panel->x_high = x.high;
  }
}

void share_costs(LogFigure& figure) {
  std::vector<LogPanel*> free_times, diffusion;
  for (LogSection& section : figure.sections) {
    for (LogPanel& panel : section.panels) {
      if (panel.x_label == cost_label) free_times.push_back(&panel);
      if (panel.x_label == brownian_label) diffusion.push_back(&panel);
    }
  }
  share_costs(free_times);
  share_costs(diffusion);
}

// The axis of costs is named only in the lowest panel of a column whose costs have the same meaning.
void label_lowest(LogFigure& figure) {
  for (LogSection& section : figure.sections) {
    for (std::size_t k = 0; k + figure.columns < section.panels.size(); ++k) {
      if (section.panels[k].x_label == section.panels[k + figure.columns].x_label) section.panels[k].x_label.clear();
    }
  }
}

// Rollback's frames in a time dt: one, if time advances as it should.
LogPanel crowd_panel(const ChartResult& result) {
  LogPanel panel;
  panel.title = "rollback stalls: frames per dt";
  panel.x_label = "disks, fluid";
  Range x, y;
  for (const Method method : {Method::rollback, Method::pairwise}) {
    for (const double dt : {0.032, 0.008}) {
      const bool rollback = method == Method::rollback;
      if (!rollback && dt != 0.032) continue;
      LogCurve curve{static_cast<int>(method), "", {}, dt != 0.032, false};
      for (const chart::CrowdPoint& p : result.crowd) {
        if (p.method != method || p.dt != dt) continue;
        // Pairwise divides steps in which a disk moves too far, whatever the number of disks; each counts as one step.
        curve.points.push_back({static_cast<double>(p.disks), p.frames, 0.0, false});
        x.add(static_cast<double>(p.disks));
        y.add(p.frames);
      }
      if (curve.points.empty()) continue;
      curve.name = rollback ? fmt::format("rollback, dt = {:g}", dt) : "pairwise";
      panel.curves.push_back(std::move(curve));
    }
  }
  const Range shown = widened(x);
  panel.x_low = shown.low;
  panel.x_high = shown.high;
  panel.y_low = 0.5;
  panel.y_high = 100.0;
  return panel;
}

const char* figure_name(const SceneResult& result) {
  switch (result.scene.figure) {
    case Figure::cooling:
      return "cooling rate";
    case Figure::spread:
      return "mean square displacement";
    default:
      return "pressure";
  }
}

const SceneResult& scene_of(const ChartResult& result, const std::string& name) {
  return *std::find_if(result.scenes.begin(), result.scenes.end(),
                       [&](const SceneResult& s) { return s.scene.name == name; });
}

// Writes the range of pairwise's steps.
void note_steps(const SceneResult& result, LogPanel& panel) {
  for (const LogCurve& curve : panel.curves) {
    if (curve.style != static_cast<int>(Method::pairwise) || curve.points.size() < 2) continue;
    const Curve& own = *std::find_if(result.curves.begin(), result.curves.end(),
                                     [](const Curve& c) { return c.method == Method::pairwise; });
    panel.remark = fmt::format("dt = {:.3g} to {:.2g}", own.points.front().dt, own.points.back().dt);
    return;
  }
}

std::vector<LogPanel> error_panels(const SceneResult& scene) {
  return {error_panel(scene, {Measure::path}, "path"),
          error_panel(scene, {Measure::rate}, "collision rate"),
          error_panel(scene, {Measure::figure}, figure_name(scene)),
          error_panel(scene, {Measure::energy, Measure::momentum}, "energy drift (dashed: momentum)"),
          error_panel(scene, {Measure::overlap}, "largest overlap"),
          error_panel(scene, {Measure::missed, Measure::spurious}, "missed (dashed: spurious)")};
}

}  // namespace

LogFigure main_figure(const ChartResult& result) {
  LogFigure figure{"What a run costs, and how wrong it is", caption, 4, {}};
  LogSection paths{"A   Paths: mean distance from exact after two mean free times, over how far disks moved", {}};
  for (const SceneResult& scene : result.scenes) {
    paths.panels.push_back(error_panel(scene, {Measure::path}, scene.scene.title));
    note_steps(scene, paths.panels.back());
  }
  paths.panels.push_back(crowd_panel(result));
  const SceneResult& fluid = scene_of(result, "fluid");
  LogSection others{"B   The other errors, relative, on the fluid unless said otherwise", {}};
  others.panels.push_back(error_panel(fluid, {Measure::rate}, "collision rate"));
  others.panels.push_back(error_panel(fluid, {Measure::figure}, "pressure"));
  others.panels.push_back(
      error_panel(scene_of(result, "cooling"), {Measure::figure}, "granular cooling: cooling rate"));
  others.panels.push_back(error_panel(scene_of(result, "brownian"), {Measure::figure}, "Brownian: displacement²"));
  others.panels.push_back(
      error_panel(fluid, {Measure::missed, Measure::spurious}, "collisions missed (dashed: spurious)"));
  others.panels.push_back(error_panel(fluid, {Measure::overlap}, "largest overlap"));
  others.panels.push_back(error_panel(fluid, {Measure::energy, Measure::momentum}, "energy drift (dashed: momentum)"));
  others.panels.push_back(error_panel(scene_of(result, "gravity"), {Measure::energy}, "gravity: energy drift"));
  figure.sections = {std::move(paths), std::move(others)};
  share_costs(figure);
  label_lowest(figure);
  return figure;
}

LogFigure own_figure(const ChartResult& result) {
  const SceneResult& scene = result.scenes.front();
  LogFigure figure{fmt::format("{}: what a run costs, and how wrong it is", scene.scene.title), "", 3, {}};
  figure.caption = scene.scene.same_start ? alike_caption : own_caption;
  LogSection section{
      fmt::format("Paths to t = {:.3g}, the other errors to t = {:.3g}", scene.scene.flight, scene.scene.length),
      error_panels(scene)};
  note_steps(scene, section.panels.front());
  std::erase_if(section.panels, [](const LogPanel& panel) { return panel.curves.empty(); });
  figure.sections.push_back(std::move(section));
  share_costs(figure);
  label_lowest(figure);
  return figure;
}

LogFigure whole_figure(const ChartResult& result) {
  LogFigure figure{"Every scene, every error", caption, 6, {}};
  for (const SceneResult& scene : result.scenes) figure.sections.push_back({scene.scene.title, error_panels(scene)});
  share_costs(figure);
  label_lowest(figure);
  return figure;
}

}  // namespace carom
