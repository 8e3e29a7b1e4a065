#include "app/chart/chart_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "core/scene/scene_names.hpp"

namespace carom::chart {

namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
}

void add_point(std::string& text, const SceneResult& scene, const Curve& curve, const Point& p) {
  for (std::size_t m = 0; m < measure_count; ++m) {
    const auto measure = static_cast<Measure>(m);
    if (measure == Measure::cost || !std::isfinite(p.errors[m].value)) continue;
    const auto& fit = curve.fits[m];
    const std::optional<double> predicted = predicted_order(scene.scene, curve.method, measure);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{}\n", scene.scene.name,
                   name_of(curve.method), number(p.dt), p.seeds, number(p.cost), measure_names[m],
                   number(p.errors[m].value), number(p.errors[m].error),
                   is_seen({p.dt, p.errors[m].value, p.errors[m].error}) ? 1 : 0, fit ? number(fit->order) : "",
                   fit ? number(fit->order_error) : "", predicted ? number(*predicted) : "");
  }
}

// The cost x at which log y reaches log error, on the line between two points.
double crossing(const Point& a, double ya, const Point& b, double yb, double error) {
  const double share = (std::log(ya) - std::log(error)) / (std::log(ya) - std::log(yb));
  return std::exp(std::log(a.cost) + share * (std::log(b.cost) - std::log(a.cost)));
}

}  // namespace

std::string csv_of(const ChartResult& result) {
  std::string text =
      "scene,method,dt,seeds,cost,measure,error,standard_error,seen,fitted_order,fitted_order_error,predicted_order\n";
  for (const SceneResult& scene : result.scenes) {
    for (const Curve& curve : scene.curves) {
      for (const Point& p : curve.points) add_point(text, scene, curve, p);
    }
  }
  for (const CrowdPoint& p : result.crowd) {
    fmt::format_to(std::back_inserter(text), "fluid_{},{},{},1,{},frames,{},,,,,\n", p.disks, name_of(p.method),
                   number(p.dt), number(p.cost), number(p.frames));
  }
  return text;
}

std::optional<double> cost_at(const Curve& curve, Measure measure, double error) {
  if (curve.points.empty()) return std::nullopt;
  const bool has_interval = curve.points.front().dt > 0.0;
  if (curve.method == Method::exact && !(has_interval && measure == Measure::figure)) return curve.points.front().cost;
  const Point* before = nullptr;
  for (const Point& p : curve.points) {
    const Mean& m = p[measure];
    if (!is_seen({p.dt, m.value, m.error})) continue;
    if (std::abs(m.value) <= error) {
      if (before == nullptr) return p.cost;
      return crossing(*before, std::abs((*before)[measure].value), p, std::abs(m.value), error);
    }
    before = &p;
  }
  return std::nullopt;
}

}  // namespace carom::chart
