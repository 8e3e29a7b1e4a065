#include "app/chart/chart_result.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/sample_mean.hpp"

namespace carom::chart {

namespace {

constexpr std::array<Method, 3> methods{Method::rollback, Method::pairwise, Method::exact};

// A single run has no scatter: its mean may be entirely wrong.
Mean mean_of(const std::vector<double>& values) {
  const SampleMean mean = sample_mean(values);
  return {mean.mean, mean.samples > 1 ? mean.standard_error() : std::abs(mean.mean)};
}

// All samples of one setting, and those of exact with which they are compared, seed by seed.
struct Series {
  Method method = Method::exact;
  double dt = 0.0;
  std::vector<Sample> own;
  std::vector<Sample> exact;
};

const Sample* find(const std::vector<Sample>& samples, Method method, double dt) {
  const auto it =
      std::find_if(samples.begin(), samples.end(), [&](const Sample& s) { return s.method == method && s.dt == dt; });
  return it == samples.end() ? nullptr : &*it;
}

Series series_of(const std::vector<std::vector<Sample>>& samples, Method method, double dt, bool brownian) {
  Series series{method, dt, {}, {}};
  for (const std::vector<Sample>& of_seed : samples) {
    const Sample* const own = find(of_seed, method, dt);
    const Sample* const exact = find(of_seed, Method::exact, brownian ? dt : 0.0);
    if (own == nullptr || exact == nullptr) continue;
    series.own.push_back(*own);
    series.exact.push_back(*exact);
  }
  return series;
}

// The relative difference from exact, over seeds; for exact itself the relative error of its own mean.
Mean against_exact(const Series& series, Measure m) {
  std::vector<double> exact, difference;
  for (std::size_t k = 0; k < series.own.size(); ++k) {
    exact.push_back(series.exact[k][m]);
    difference.push_back(series.own[k][m] - series.exact[k][m]);
  }
  const Mean reference = mean_of(exact);
  if (series.method == Method::exact) return {0.0, reference.error / std::abs(reference.value)};
  const Mean off = mean_of(difference);
  return {off.value / reference.value, off.error / std::abs(reference.value)};
}

std::vector<double> column(const std::vector<Sample>& samples, Measure m) {
  std::vector<double> values;
  for (const Sample& s : samples) values.push_back(s[m]);
  return values;
}

Point point_of(const Series& series, double unit, bool same_start) {
  Point p;
  p.dt = series.dt;
  p.seeds = same_start ? 1 : series.own.size();
  const std::vector<double> costs = column(series.own, Measure::cost);
  p.cost = unit * *std::min_element(costs.begin(), costs.end());
  for (std::size_t m = 0; m < measure_count; ++m) p.errors[m] = mean_of(column(series.own, static_cast<Measure>(m)));
  for (const Measure m : {Measure::rate, Measure::figure}) {
    p.errors[static_cast<std::size_t>(m)] = against_exact(series, m);
  }
  return p;
}

// The spread of Brownian motion has an error by the step itself, even with exact: it is compared with exact at the
// shortest step.
void compare_spreads(const std::vector<std::vector<Sample>>& samples, double shortest, SceneResult& result) {
  const Series best = series_of(samples, Method::exact, shortest, true);
  const Mean reference = mean_of(column(best.own, Measure::figure));
  result.figure = reference.value;
  for (Curve& curve : result.curves) {
    for (Point& p : curve.points) {
      const Mean own = mean_of(column(series_of(samples, curve.method, p.dt, true).own, Measure::figure));
      const bool itself = curve.method == Method::exact && p.dt == shortest;
      p.errors[static_cast<std::size_t>(Measure::figure)] = {
          itself ? 0.0 : own.value / reference.value - 1.0,
          (itself ? reference.error : std::hypot(own.error, reference.error)) / reference.value};
    }
  }
}

void fit_curve(Curve& curve) {
  for (std::size_t m = 0; m < measure_count; ++m) {
    if (static_cast<Measure>(m) == Measure::cost) continue;
    std::vector<FitPoint> points;
    for (const Point& p : curve.points) {
      if (p.dt > 0.0) points.push_back({p.dt, p.errors[m].value, p.errors[m].error});
    }
    curve.fits[m] = fit_order(points);
  }
}

}  // namespace

std::optional<double> predicted_order(const ChartScene& scene, Method method, Measure measure) {
  if (method == Method::exact) return std::nullopt;
  switch (measure) {
    case Measure::path:
    case Measure::rate:
    case Measure::figure:
    case Measure::missed:
    case Measure::spurious:
      return scene.figure == Figure::spread ? 0.5 : 1.0;
    default:
      return std::nullopt;  // energy and momentum are kept to rounding, overlaps are pushed away: no prediction
  }
}

SceneResult summed_up(const ChartScene& scene, const std::vector<std::vector<Sample>>& samples) {
  const bool brownian = scene.figure == Figure::spread;
  SceneResult result{scene, 1.0, 0.0, {}, {}};
  std::vector<Sample> exact;
  std::vector<double> steps;  // of any seed, descending
  for (const auto& of_seed : samples) {
    for (const Sample& s : of_seed) {
      if (s.method == Method::exact) exact.push_back(s);
      if (std::find(steps.begin(), steps.end(), s.dt) == steps.end()) steps.push_back(s.dt);
    }
  }
  std::sort(steps.rbegin(), steps.rend());
  if (brownian) result.unit = scene.unit;
  if (!brownian) result.unit = 1.0 / mean_of(column(exact, Measure::rate)).value;
  result.figure = mean_of(column(exact, Measure::figure)).value;
  for (const Method method : methods) {
    Curve curve{method, {}, {}};
    for (const double dt : steps) {
      const Series series = series_of(samples, method, dt, brownian);
      const auto stopped = std::ranges::find_if(series.own, [](const Sample& s) { return !s.stopped.empty(); });
      if (stopped != series.own.end()) {
        result.stops.push_back({method, dt, stopped->stopped});
        continue;
      }
      if (!series.own.empty()) curve.points.push_back(point_of(series, result.unit, scene.same_start));
    }
    result.curves.push_back(std::move(curve));
  }
  if (brownian) compare_spreads(samples, steps.back(), result);
  for (Curve& curve : result.curves) fit_curve(curve);
  return result;
}

}  // namespace carom::chart
