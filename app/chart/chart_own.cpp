#include "app/chart/chart_own.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/state_hash.hpp"
#include "core/measure/energy_gain.hpp"
#include "core/scene/scene_text.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"
#include "parallel/simulation.hpp"

namespace carom::chart {

namespace {

// The mean number of collisions of a disk up to which paths are compared, and over which rates are taken.
constexpr double path_collisions = 2.0, rate_collisions = 25.0;

// Brownian motion, as in the chart's own scene: the longest step moves a disk by this share of its radius in each
// direction (root mean square); paths are compared after this number of these steps, rates taken over this number.
constexpr double brownian_travel = 0.226, brownian_flight = 4.0, brownian_length = 40.0;

[[noreturn]] void refuse(const Scene& scene, const std::string& what, const std::string& expected) {
  fail_input(scene.file, fmt::format("cannot be charted: {}", what), expected);
}

void check_kind(const Scene& scene) {
  const Count disks = disks_that_move(scene);
  if (!scene.sources.empty()) refuse(scene, "sources add disks", "expected the same disks from start to end");
  if (has_sinks(scene)) refuse(scene, "sinks remove disks", "expected the same disks from start to end");
  if (disks < 2) refuse(scene, "nothing collides", "expected two disks or more");
  if (disks > most_own_disks) {
    refuse(scene, fmt::format("{} disks are too many to compare path by path", disks),
           fmt::format("expected {} or fewer, such as a smaller box of the same density", most_own_disks));
  }
  if (scene.physics.accumulate) {
    refuse(scene, "with physics.accumulate the step is part of the physics", "expected a scene without it");
  }
  if (!(scene.run.t_end > 0.0)) refuse(scene, "t_end is 0", "expected a run of some length");
}

// The result of the run by exact.
struct Trial {
  double flight = 0.0, length = 0.0;
  double travel2 = 0.0;  // largest (speed / radius)^2 seen
  double collisions = 0.0;
};

// Takes a copy of the disks, since a view may change them.
double largest_travel2_of(Disks d) {
  return with_view(d, [&](const auto& view) { return largest_travel2(view, 0, d.size()); });
}

// The time of this number of collisions, interpolated between two known numbers.
double time_of(double wanted, double t0, double c0, double t1, double c1) {
  return c1 > c0 ? t0 + (t1 - t0) * (wanted - c0) / (c1 - c0) : t1;
}

Trial try_exact(const Scene& scene, const Scene& run, const State& start) {
  const double t_end = run.run.t_end;
  const double pairs = 0.5 * static_cast<double>(start.disks.size());  // each collision is one of two disks
  Trial trial;
  const auto engine = make_parallel_engine(run, start, {1});
  engine->forget_paths();
  double time = 0.0, before = 0.0;
  try {
    while (time < t_end && trial.length == 0.0) {
      trial.travel2 = std::max(trial.travel2, largest_travel2_of(engine->state().disks));
      engine->step();
      const double now = engine->state().time;
      trial.collisions = static_cast<double>(engine->state().counters.collisions);
      const auto reached = [&](double each) { return trial.collisions >= each * pairs; };
      const auto when = [&](double each) { return time_of(each * pairs, time, before, now, trial.collisions); };
      if (trial.flight == 0.0 && reached(path_collisions)) trial.flight = when(path_collisions);
      if (reached(rate_collisions)) trial.length = when(rate_collisions);
      time = now;
      before = trial.collisions;
    }
  } catch (const PhysicsError& error) {
    refuse(scene, fmt::format("exact, which all others are compared with, stops: {}", error.what()),
           fmt::format("expected a t_end before that (--t-end {:.3g})", 0.9 * time));
  }
  trial.travel2 = std::max(trial.travel2, largest_travel2_of(engine->state().disks));
  if (trial.flight == 0.0) trial.flight = t_end;
  if (trial.length == 0.0) trial.length = t_end;
  return trial;
}

bool starts_alike(const Scene& scene, const State& start) {
  Scene other = scene;
  ++other.seed;
  return state_hash(initial_state(other).disks) == state_hash(start.disks);
}

void plan_brownian(const Scene& scene, const Disks& disks, ChartScene& chart) {
  const double share = brownian_travel * smallest_radius(disks);
  const double diffusion = scene.physics.diffusion;
  const double longest = share * share / (2.0 * diffusion);
  chart.longest_step = std::min(longest, scene.run.t_end / brownian_flight);
  chart.flight = brownian_flight * chart.longest_step;
  chart.length = std::min(scene.run.t_end, brownian_length * chart.longest_step);
  chart.unit = 4.0 * smallest_radius(disks) * smallest_radius(disks) / diffusion;
  chart.figure = Figure::spread;
  chart.keeps_energy = chart.keeps_momentum = false;
}

void plan_flight(const Scene& scene, const Trial& trial, ChartScene& chart) {
  chart.flight = std::min(trial.flight, scene.run.t_end);
  chart.length = std::min(trial.length, scene.run.t_end);
  chart.longest_step = std::min(0.98 * safe_travel / std::sqrt(trial.travel2), 0.5 * chart.flight);
  const bool obstacles = !scene.walls.empty() || std::ranges::any_of(scene.groups, &DiskGroup::fixed);
  const bool walls = scene.box.has(SideKind::wall) || obstacles;
  const bool kicked = scene.physics.thermostat.acts();
  const bool elastic = !disks_dissipate(scene) && !scene.box.walls_dissipate() && !inner_walls_dissipate(scene) &&
                       !walls_rub(scene) && !scene.box.has_thermal_side() && !scene.box.inner_walls_move && !kicked;
  chart.keeps_energy = elastic && !falls_for_ever(scene);
  chart.keeps_momentum = !walls && !scene.physics.gravity.acts() && !kicked;
  // Haff's law is for a gas that nothing heats; the flow of a sheared box does.
  const bool cools = !elastic && chart.keeps_momentum && !scene.box.shear.acts();
  chart.figure = cools ? Figure::cooling : Figure::pressure;
}

}  // namespace

Count disks_that_move(const Scene& scene) {
  Count disks = 0;
  for (const DiskGroup& group : scene.groups) disks += group.fixed ? 0 : group.count;
  return disks;
}

ChartScene own_scene(const Scene& scene) {
  check_kind(scene);
  ChartScene chart;
  std::string stem = scene.file.substr(scene.file.find_last_of('/') + 1);
  stem = stem.substr(0, stem.find_last_of('.'));
  const auto parts_cells = [](char c) { return c == ',' || c == '"' || static_cast<unsigned char>(c) < ' '; };
  std::replace_if(stem.begin(), stem.end(), parts_cells, '_');  // it names rows of chart.csv
  chart.name = stem;
  chart.title = scene.title.empty() ? stem : scene.title;
  chart.text = resolved_toml(scene);
  chart.own = std::make_shared<const Scene>(scene);
  const State start = initial_state(scene);
  chart.same_start = starts_alike(scene, start);
  const bool brownian = scene.physics.diffusion > 0.0;
  if (brownian) plan_brownian(scene, start.disks, chart);
  const Scene run =
      scene_of(chart, 1, Method::exact, brownian ? chart.longest_step : 0.0, brownian ? chart.length : scene.run.t_end);
  const Trial trial = try_exact(scene, run, start);
  if (trial.collisions == 0.0) {
    refuse(scene, fmt::format("no two disks collide by t = {:g}", run.run.t_end), "expected a longer run (--t-end)");
  }
  if (!brownian) plan_flight(scene, trial, chart);
  if (scene.run.dt > 0.0 && scene.run.dt <= chart.longest_step) chart.own_step = scene.run.dt;
  return chart;
}

}  // namespace carom::chart
