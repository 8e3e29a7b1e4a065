#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "io/files/output_file.hpp"
#include "io/plots/gnuplot_run.hpp"
#include "parallel/simulation.hpp"
#include "tests/stability/map.hpp"
#include "tests/stability/map_frame.hpp"

namespace carom::stability {

namespace {

// The unit of time is a diameter over the thermal speed.
constexpr std::array<double, 10> packing{0.05, 0.10, 0.20, 0.30, 0.40, 0.50, 0.60, 0.70, 0.80, 0.88};
constexpr double first_dt = 1e-3;
constexpr double dt_factor = 2.0;
constexpr int dt_count = 10;
constexpr double aimed_collisions = 4e4;  // in a run: 0.5 % of noise
constexpr double most_steps = 2e5;        // longer runs are left out: their error is noise

struct Cell {
  std::string method;
  std::size_t column = 0;
  int row = 0;
  double dt = 0.0, rate = 0.0, exact_rate = 0.0;
  bool warned = false, ended = true;
  double error() const { return ended ? std::abs(rate / exact_rate - 1.0) : 1.0; }
};

Scene gas(double phi, const std::string& method, double dt, double t_end) {
  return parse_scene(
      fmt::format("[box]\npacking_fraction = {}\naspect = 0.9622504486493763\nleft = \"periodic\"\n"
                  "right = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n[[disks]]\ncount = 480\n"
                  "positions = \"hexagonal\"\nvelocities = {{ maxwell = 1.0 }}\nradius = 0.5\nmass = 1.0\n"
                  "[run]\nmethod = \"{}\"\ndt = {}\nt_end = {}\n",
                  phi, method, dt, t_end),
      "map", "");
}

struct Run {
  double rate = 0.0;
  bool warned = false, ended = true;
};

// Collisions of a disk per unit of time over the whole run.
Run run(const Scene& scene) {
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1});
  engine->forget_paths();
  Run result;
  try {
    while (engine->state().time < scene.run.t_end && static_cast<double>(engine->state().counters.steps) < most_steps)
      engine->step();
  } catch (const PhysicsError&) {
    result.warned = true;
  }
  const State& end = engine->state();
  result.ended = end.time >= scene.run.t_end;
  result.warned = result.warned || !engine->take_warnings().empty();
  if (end.time > 0.0) {
    result.rate =
        2.0 * static_cast<double>(end.counters.collisions) / (static_cast<double>(end.disks.size()) * end.time);
  }
  return result;
}

// 4 (Z - 1) / sqrt(pi) with Henderson's Z for the fluid and free volumes for the crystal, to choose the length of a
// run.
double rough_rate(double phi) {
  const double fluid = (1.0 + phi * phi / 8.0) / ((1.0 - phi) * (1.0 - phi)) - 1.0;
  const double crystal = 2.0 / (0.9069 / phi - 1.0);
  return 2.26 * (phi < 0.7 ? fluid : crystal);
}

std::vector<Cell> measure_cells() {
  std::vector<Cell> cells;
  for (std::size_t column = 0; column < packing.size(); ++column) {
    const double t_end = 2.0 * aimed_collisions / (480.0 * rough_rate(packing[column]));
    const double exact = run(gas(packing[column], "exact", 0.1, t_end)).rate;
    for (const char* const method : {"rollback", "pairwise"}) {
      for (int row = 0; row < dt_count; ++row) {
        if (t_end / (first_dt * std::pow(dt_factor, row)) > most_steps) continue;
        Cell c{method, column, row, first_dt * std::pow(dt_factor, row), 0.0, exact};
        const Run r = run(gas(packing[column], method, c.dt, t_end));
        c.rate = r.rate;
        c.warned = r.warned;
        c.ended = r.ended;
        cells.push_back(c);
      }
    }
  }
  return cells;
}

std::string data_of(const std::vector<Cell>& cells) {
  std::string text;
  for (const std::string method : {"rollback", "pairwise"}) {
    for (const Cell& c : cells) {
      if (c.method != method) continue;
      text += fmt::format("{} {} {} {} {}\n", c.column, c.row, std::clamp(c.error(), 1e-3, 1.0), c.warned ? 1 : 0,
                          c.ended ? 1 : 0);
    }
    text += "\n\n";
  }
  // Lines where a disk collides 0.1 and 1 times in dt.
  for (const double share : {0.1, 1.0}) {
    for (const Cell& c : cells) {
      if (c.method == "pairwise" && c.row + 1 == dt_count) {
        text += fmt::format("{} {}\n", c.column, std::log(share / (c.exact_rate * first_dt)) / std::log(dt_factor));
      }
    }
    text += "\n\n";
  }
  return text;
}

std::string script_of() {
  Axis x{"packing fraction", {}};
  Axis y{"dt (diameter / thermal speed)", {}};
  for (const double phi : packing) x.labels.push_back(fmt::format("{:.2f}", phi));
  for (int row = 0; row < dt_count; ++row) y.labels.push_back(fmt::format("{:g}", first_dt * std::pow(dt_factor, row)));
  std::string text = map_header(1080, 560) +
                     "set multiplot layout 1,2 title 'Error of the collision rate, against exact' font 'sans-serif,17' "
                     "margins 0.085,0.88,0.2,0.86 spacing 0.07\n"
                     "set logscale cb\nset cbrange [1e-3:1]\nset cbtics ('0.1 %%' 1e-3, '1 %%' 1e-2, '10 %%' 1e-1, "
                     "'100 %%' 1)\nset label 1 'dot: warns    cross: stops    lines: 0.1 and 1 collisions of a "
                     "disk in dt' at screen 0.48, 0.045 center\n";
  for (int panel = 0; panel < 2; ++panel) {
    text += map_axes(panel == 0 ? "rollback" : "pairwise", x, panel == 0 ? y : Axis{"", y.labels});
    text += panel == 0 ? "unset colorbox\n" : "set colorbox user origin 0.9,0.2 size 0.015,0.66\nunset label 1\n";
    text += fmt::format(
        "plot 'data' index {0} using 1:2:(0.48):(0.48):3 with boxxyerror fc palette, "
        "'' index {0} using 1:($4 > 0 && $5 > 0 ? $2 : NaN) with points pt 7 ps 0.45 lc rgb '#d95f02', "
        "'' index {0} using 1:($5 < 1 ? $2 : NaN) with points pt 2 ps 0.7 lw 1.6 lc rgb '#ff8c2a', "
        "'' index 2 with lines lw 1.6 lc rgb '#222222' dt 3, '' index 3 with lines lw 1.6 lc rgb '#222222'\n",
        panel);
  }
  return text + "unset multiplot\n";
}

}  // namespace

void write_dt_map(const std::string& folder) {
  const std::vector<Cell> cells = measure_cells();
  std::string csv = "method,packing_fraction,dt,rate,exact_rate,error,warned,ended\n";
  for (const Cell& c : cells) {
    csv += fmt::format("{},{},{},{},{},{},{},{}\n", c.method, packing[c.column], c.dt, c.rate, c.exact_rate, c.error(),
                       c.warned ? "yes" : "no", c.ended ? "yes" : "no");
  }
  write_file(folder + "/stability_dt.csv", csv);
  run_gnuplot(script_of(), data_of(cells), {{"plot.svg", folder + "/stability_dt.svg"}});
}

}  // namespace carom::stability
